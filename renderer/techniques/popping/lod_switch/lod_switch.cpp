// SPDX-License-Identifier: BSD-3-Clause
// How visible a change of level of detail is: the popping predictor on the frames of one object's change
// (SP-39 to SP-52; Schwarz 2009, chapter 10). The product is the weighted difference map in JND; its
// consequences for a viewer are counters.
//
// Choices. The frame is a window of the display, pixel for pixel: in a picture of twice the size everything
// is twice as large on the retina. The frames are not rounded to 8 bits. In a static presentation nothing
// moves and nothing flickers, so weights are 1, as they are for a camera at rest.
#include <algorithm>

#include "perception/popping/popping_gpu.h"
#include "perception/popping/weights_gpu.h"
#include "renderer/techniques/popping/switch_figures.h"

namespace limen::techniques {
namespace {

class LodSwitch : public Technique {
 public:
  using Settings = SwitchSettings;
  explicit LodSwitch(const SwitchSettings& settings) : setting_(settings) {}

  void prepare(frame::Frame& frame) override {
    views_.emplace(frame, setting_);
    predictor_.emplace(frame.context(), frame.sizePx(), setting_.display, setting_.popping, true);
    frame.passes().setBytesHeld("popping/collapse", predictor_->bytesHeld());
    if (!setting_.usesDisocclusion() && !setting_.usesFlicker()) return;
    weights_.emplace(frame.context(), setting_.popping);
    if (setting_.usesDisocclusion()) disocclusion_.emplace(gl::Format::R32F, frame.sizePx());
    if (setting_.usesFlicker()) flicker_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld(
        "popping/weights", (disocclusion_ ? disocclusion_->bytes() : 0) + (flicker_ ? flicker_->bytes() : 0));
  }

  void render(frame::Frame& frame) override {
    views_->render(frame);
    const frame::LodPair::View &now = views_->pair().actual(), &old = views_->pair().predicted();
    if (weights_) {
      const auto pass = frame.passes().open("popping/weights");
      if (disocclusion_)
        weights_->disocclusion({{now.previousDepth, now.displacement, now.depthBefore},
                                {old.previousDepth, old.displacement, old.depthBefore}},
                               *disocclusion_);
      if (flicker_) {
        const frame::LodPair::View& view = views_->flickering();
        const SwitchViews::FlickerPictures pictures = views_->flickerPictures();
        weights_->flicker({pictures.actual, pictures.predicted, pictures.previousShading,
                           pictures.previousFrame, view.displacement, view.previousDepth, old.depthBefore},
                          *flicker_);
      }
    }
    predictor_->run({&views_->actual(), &views_->predicted(), true, now.displacement, old.displacement,
                     disocclusion_ ? &*disocclusion_ : nullptr, flicker_ ? &*flicker_ : nullptr},
                    &frame.passes());
  }

  const gl::Texture& product() const override { return predictor_->jnd(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const Image jnd = product().read();
    const perception::PoppingPredictorGpu::Counts counts = predictor_->readCounts();
    return switchFigures(frame, setting_, views_->read(),
                         {predictor_->readRegions(), *std::max_element(jnd.data.begin(), jnd.data.end()),
                          counts.flushedInputs, counts.guardedContrasts});
  }

  std::map<std::string, PictureMaker> pictures() const override {
    return {{"regions", [views = views_->read(), regions = predictor_->readRegions()] {
               return regionPicture(views, regions);
             }}};
  }

  std::map<std::string, const gl::Texture*> debugViews() const override {
    std::map<std::string, const gl::Texture*> out = {
        {"actual", &views_->actual()}, {"predicted", &views_->predicted()}, {"jnd", &predictor_->jnd()}};
    if (disocclusion_) out["disocclusion"] = &*disocclusion_;
    if (flicker_) out["flicker"] = &*flicker_;
    return out;
  }

 private:
  SwitchSetting setting_;
  std::optional<SwitchViews> views_;
  std::optional<perception::PoppingPredictorGpu> predictor_;
  std::optional<perception::PoppingWeightsGpu> weights_;
  std::optional<gl::Texture> disocclusion_, flicker_;
};

const RegisteredTechnique<LodSwitch> kLodSwitchRegistered{
    {.name = "popping/lod_switch",
     .version = 3,
     .summary = "Popping predictor on one object's change of level: difference map, regions, rating",
     .source = "Schwarz 2009, chapter 10 (SP-39 to SP-52)",
     .product = ProductKind::JndMap,
     .needs = {"lod_sets"},
     .counters = switchFigureQuantities()}};

}  // namespace
}  // namespace limen::techniques
