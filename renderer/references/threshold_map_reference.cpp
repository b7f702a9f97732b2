// SPDX-License-Identifier: BSD-3-Clause
// Threshold map of the shaded frame in double precision on the CPU, without tables (SP-28). The whole model
// is parameterised: as in Ramasubramanian et al. (f_rule: original, decomposition: pyramid), as in the
// thesis, or with true Gaussians. Exact except for the frame itself, which the GPU shades.
#include <optional>

#include "perception/threshold_maps/reference.h"
#include "perception/threshold_maps/viewing.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/technique.h"

namespace limen::references {
namespace {

using techniques::Counter;

struct ThresholdMapReferenceSettings {
  perception::ThresholdMapSettings map;
  perception::ViewingSettings viewing;
  frame::ShadedSetting shading;
  static const SettingsTable<ThresholdMapReferenceSettings>& table() {
    using S = ThresholdMapReferenceSettings;
    static const SettingsTable<S> kTable = {
        {&S::map, "map", "The model"}, included(&S::viewing), frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class ThresholdMapReference : public techniques::Technique {
 public:
  using Settings = ThresholdMapReferenceSettings;
  explicit ThresholdMapReference(const Settings& settings)
      : settings_(settings.map), display_(settings.viewing.profile()), shaded_(settings.shading) {}

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
    return {{"guarded_contrasts", static_cast<double>(map_.guarded)},
            {"pixels_per_degree", display_.pixelsPerDegree()}};
  }

 private:
  perception::ThresholdMapSettings settings_;
  perception::DisplayProfile display_;
  frame::ShadedSetting shaded_;
  perception::ThresholdMap map_;
  std::optional<gl::Texture> product_;
};

const techniques::RegisteredTechnique<ThresholdMapReference> kThresholdMapReferenceRegistered{
    {.name = "perception/threshold_map_reference",
     .version = 1,
     .summary = "Single threshold map in double precision, any variant, including true Gaussians",
     .source = "Ramasubramanian et al. 1999; Schwarz 2009, sections 9.2 and 9.4 (SP-28)",
     .product = techniques::ProductKind::Threshold,
     .reference = true,
     .onCpu = true,
     .counters = {{"guarded_contrasts", "Contrasts with a bounded denominator", "", Direction::Neither},
                  {"pixels_per_degree", "Pixels per degree", "px/deg", Direction::Neither}}}};

}  // namespace
}  // namespace limen::references
