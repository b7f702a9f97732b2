// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of the shaded frame by frequency band: the popping predictor inverted. One value per pixel:
// either the combined map, below which a luminance difference of any frequencies changes no band's response
// visibly, or one band's thresholds, for differences split into bands. The comparator is
// perception/threshold_map, the map of Schwarz 2009, section 9.4, which lends one band's masking to all
// frequencies and does not hold.
#include <optional>

#include "perception/band_thresholds/band_threshold_gpu.h"
#include "perception/threshold_maps/viewing.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

struct BandThresholdTechniqueSettings {
  perception::BandThresholdSettings map;
  perception::ViewingSettings viewing;
  frame::ShadedSetting shading;
  static const SettingsTable<BandThresholdTechniqueSettings>& table() {
    using S = BandThresholdTechniqueSettings;
    static const SettingsTable<S> kTable = {
        {&S::map, "map", "The model"}, included(&S::viewing), frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class BandThresholdTechnique : public Technique {
 public:
  using Settings = BandThresholdTechniqueSettings;
  explicit BandThresholdTechnique(const Settings& settings)
      : settings_(settings.map), display_(settings.viewing.profile()), shaded_(settings.shading) {}

  void prepare(frame::Frame& frame) override {
    map_.emplace(frame.context(), frame.sizePx(), display_, settings_);
    frame.passes().setBytesHeld("band_thresholds/levels", map_->bytesHeld());
  }

  void render(frame::Frame& frame) override {
    map_->run(frame.get<frame::Shaded>(shaded_).texture(), &frame.passes());
  }

  const gl::Texture& product() const override { return map_->map(); }
  std::map<std::string, const gl::Texture*> debugViews() const override { return map_->debugViews(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const auto bytes = static_cast<double>(map_->bytesMoved(frame.get<frame::Shaded>(shaded_).texture()));
    const double pixels = double(frame.sizePx().x) * frame.sizePx().y;
    return {{"bytes_moved_per_px", bytes / pixels},
            {"frequency_bands", static_cast<double>(map_->bands())},
            {"pixels_per_degree", display_.pixelsPerDegree()}};
  }

 private:
  perception::BandThresholdSettings settings_;
  perception::DisplayProfile display_;
  frame::ShadedSetting shaded_;
  std::optional<perception::BandThresholdGpu> map_;
};

const RegisteredTechnique<BandThresholdTechnique> kBandThresholdsRegistered{
    {.name = "perception/band_thresholds",
     .version = 1,
     .summary = "Luminance differences that the predictor does not see, by frequency band and combined",
     .source = "inverse of the predictor of Schwarz 2009, section 10.3",
     .product = ProductKind::Threshold,
     .counters = {{"bytes_moved_per_px", "Bytes moved per pixel", "byte", Direction::LowerIsBetter},
                  {"frequency_bands", "Frequency bands", "", Direction::Neither},
                  {"pixels_per_degree", "Pixels per degree", "px/deg", Direction::Neither}}}};

}  // namespace
}  // namespace limen::techniques
