// SPDX-License-Identifier: BSD-3-Clause
// Threshold map of the shaded frame in double precision on the CPU, without tables (SP-28). All of the model
// is parameters: as Ramasubramanian et al. have it (f_rule: original, decomposition: pyramid), as the thesis
// has it, or with true Gaussians. Exact but for the frame itself, which the GPU shades.
#include <optional>

#include "perception/threshold_maps/reference.h"
#include "perception/threshold_maps/viewing.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/technique.h"

namespace limen::references {
namespace {

using techniques::Counter;
using techniques::TechniqueInfo;

class ThresholdMapReference : public techniques::Technique {
 public:
  explicit ThresholdMapReference(const ParameterValues& values)
      : settings_(perception::ThresholdMapSettings::table().read(values)),
        display_(perception::ViewingSettings::table().read(values).profile()),
        shaded_(frame::ShadedSetting::from(values)) {}

  void prepare(frame::Frame& frame) override {
    product_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld("threshold_map_reference", product_->bytes());
  }

  void render(frame::Frame& frame) override {
    const Image shaded = frame.get<frame::Shaded>(shaded_).texture().read();
    const auto scope = frame.passes().open("threshold_map_reference");
    map_ = perception::computeThresholdMap(perception::luminancePlane(shaded, display_),
                                           display_.pixelsPerDegree(), settings_);
    product_->write(perception::toImage(map_.thresholdCdM2));
  }

  const gl::Texture& product() const override { return *product_; }

  std::vector<Counter> count(frame::Frame&) override {
    return {{"guarded_contrasts", static_cast<double>(map_.guarded), "", false},
            {"pixels_per_degree", display_.pixelsPerDegree(), "px/deg", false}};
  }

 private:
  perception::ThresholdMapSettings settings_;
  perception::DisplayProfile display_;
  frame::ShadedSetting shaded_;
  perception::ThresholdMap map_;
  std::optional<gl::Texture> product_;
};

std::vector<Parameter> parameters() {
  std::vector<Parameter> out;
  for (const auto& group :
       {perception::ThresholdMapSettings::table().parameters(),
        perception::ViewingSettings::table().parameters(), frame::ShadedSetting::parameters()})
    out.insert(out.end(), group.begin(), group.end());
  return out;
}

const Registered<TechniqueInfo> kThresholdMapReferenceRegistered{
    {.name = "perception/threshold_map_reference",
     .version = 1,
     .summary = "Threshold map in double precision, any variant, true Gaussians too",
     .source = "Ramasubramanian et al. 1999; Schwarz 2009, sections 9.2 and 9.4 (SP-28)",
     .product = techniques::ProductKind::Threshold,
     .parameters = ParameterList([] { return parameters(); }),
     .needs = {},
     .reference = true,
     .onCpu = true,
     .make = [](const ParameterValues& values) { return std::make_unique<ThresholdMapReference>(values); },
     .errorBound = {},
     .counters = {"guarded_contrasts", "pixels_per_degree"}}};

}  // namespace
}  // namespace limen::references
