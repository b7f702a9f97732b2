// SPDX-License-Identifier: BSD-3-Clause
// Reference of popping/lod_switch (SP-51): weights and predictor in double precision on the CPU, on the same
// frames, which are rendered on the GPU. Its product is rounded to single precision; its figures are not.
#include <algorithm>

#include "renderer/techniques/popping/switch_figures.h"

namespace limen::techniques {
namespace {

class LodSwitchReference : public Technique {
 public:
  using Settings = SwitchSettings;
  explicit LodSwitchReference(const SwitchSettings& settings) : setting_(settings) {}

  void prepare(frame::Frame& frame) override {
    views_.emplace(frame, setting_);
    product_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld("popping/reference", product_->bytes());
  }

  void render(frame::Frame& frame) override {
    views_->render(frame);
    const auto pass = frame.passes().open("popping/reference");
    images_ = views_->read();
    perception::PoppingInput input = images_.input;
    input.isSwitch = true;
    if (!images_.disocclusion.empty())
      input.disocclusion =
          perception::disocclusionWeight(images_.disocclusion, setting_.popping.disocclusionSettings());
    if (images_.flicker)
      input.flicker = perception::flickerWeight(*images_.flicker, setting_.popping.flickerSettings());
    result_ = perception::predictPopping(input, setting_.display, setting_.popping);
    product_->write(result_.jnd);
  }

  const gl::Texture& product() const override { return *product_; }

  std::vector<Counter> count(frame::Frame& frame) override {
    return switchFigures(
        frame, setting_, images_,
        {result_.regions, result_.summary.largestJnd, result_.flushedInputs, result_.guardedContrasts});
  }

  std::map<std::string, PictureMaker> pictures() const override {
    return {{"regions", [picture = regionPicture(images_, result_.regions)] { return picture; }}};
  }

 private:
  SwitchSetting setting_;
  std::optional<SwitchViews> views_;
  std::optional<gl::Texture> product_;
  SwitchImages images_;
  perception::PoppingResult result_;
};

const RegisteredTechnique<LodSwitchReference> kLodSwitchReferenceRegistered{
    {.name = "popping/lod_switch_reference",
     .version = 3,
     .summary = "Popping predictor in double precision on the frames of one object's change of level",
     .source = "Schwarz 2009, chapter 10 (SP-51)",
     .product = ProductKind::JndMap,
     .needs = {"lod_sets"},
     .reference = true,
     .onCpu = true,
     .counters = switchFigureQuantities()}};

}  // namespace
}  // namespace limen::techniques
