// SPDX-License-Identifier: BSD-3-Clause
// Luminance thresholds of the shaded frame in double precision on the CPU, without tables (SP-28). The whole
// model is parameterised; of the single map as in Ramasubramanian et al. (frequency_elevation: original,
// decomposition: pyramid), as in the thesis, or with true Gaussians. Exact except for the frame itself, which
// the GPU shades.
#include <optional>

#include "perception/threshold_maps/reference.h"
#include "perception/threshold_maps/viewing.h"
#include "perception/thresholds/thresholds.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/technique.h"

namespace limen::references {
namespace {

using techniques::Counter;

struct ThresholdMapReferenceSettings {
  perception::ThresholdSettings thresholds;
  perception::ViewingSettings viewing;
  frame::ShadedSetting shading;
  static const SettingsTable<ThresholdMapReferenceSettings>& table() {
    using S = ThresholdMapReferenceSettings;
    static const SettingsTable<S> kTable = {{&S::thresholds, "thresholds", perception::kThresholdsText},
                                            included(&S::viewing),
                                            frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class ThresholdMapReference : public techniques::Technique {
 public:
  using Settings = ThresholdMapReferenceSettings;
  explicit ThresholdMapReference(const Settings& settings)
      : settings_(settings.thresholds), display_(settings.viewing.profile()), shaded_(settings.shading) {}

  void prepare(frame::Frame& frame) override {
    product_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld("threshold_map_reference", product_->bytes());
  }

  void render(frame::Frame& frame) override {
    const Image shaded = frame.get<frame::Shaded>(shaded_).texture().read();
    const auto scope = frame.passes().open("threshold_map_reference");
    const perception::Thresholds made =
        perception::computeThresholds(perception::luminancePlane(shaded, display_), display_, settings_);
    guarded_ = made.guarded;
    product_->write(perception::toImage(made.thresholdCdM2));
  }

  const gl::Texture& product() const override { return *product_; }

  std::vector<Counter> count(frame::Frame&) override {
    return {{"guarded_contrasts", static_cast<double>(guarded_)},
            {"pixels_per_degree", display_.pixelsPerDegree()}};
  }

 private:
  perception::ThresholdSettings settings_;
  perception::DisplayProfile display_;
  frame::ShadedSetting shaded_;
  int64_t guarded_ = 0;
  std::optional<gl::Texture> product_;
};

const techniques::RegisteredTechnique<ThresholdMapReference> kThresholdMapReferenceRegistered{
    {.name = "perception/threshold_map_reference",
     .version = 2,
     .summary = "Luminance thresholds in double precision, any variant, including true Gaussians",
     .source =
         "inverse of the predictor of Schwarz 2009, section 10.3; Ramasubramanian et al. 1999; Schwarz 2009, "
         "sections 9.2 and 9.4 (SP-28)",
     .product = techniques::ProductKind::Threshold,
     .reference = true,
     .onCpu = true,
     .counters = {{"guarded_contrasts", "Contrasts with a bounded denominator", "", Direction::Neither},
                  {"pixels_per_degree", "Pixels per degree", "px/deg", Direction::Neither}}}};

}  // namespace
}  // namespace limen::references
