// SPDX-License-Identifier: BSD-3-Clause
// The thesis's threshold map of the shaded frame (SP-29 to SP-34): for each pixel one luminance increment,
// taken for the threshold of differences of any frequencies. It lends the masking of one band to all others,
// so that differences below it may be plainly visible: a comparator for perception/band_thresholds. Source:
// Schwarz 2009, section 9.4, in compute. Departures, each a parameter if it changes the map: the kernel,
// which the thesis leaves open, is the binomial one; the adaptation luminance is blended from two levels so
// that it is a mean over one degree, whereas the pixels of the nearest level are only about a degree apart; a
// small contrast is added so that flat regions have an elevation of 1; the stack exists for one tile at a
// time; 16 bits store bands instead of luminances.
#include <optional>

#include "perception/threshold_maps/threshold_map_gpu.h"
#include "perception/threshold_maps/viewing.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

struct ThresholdMapTechniqueSettings {
  perception::ThresholdMapSettings map;
  perception::ThresholdMapGpuSettings gpu;
  perception::ViewingSettings viewing;
  frame::ShadedSetting shading;
  static const SettingsTable<ThresholdMapTechniqueSettings>& table() {
    using S = ThresholdMapTechniqueSettings;
    static const SettingsTable<S> kTable = {{&S::map, "map", "The model"},
                                            {&S::gpu, "gpu", "How the GPU computes it"},
                                            included(&S::viewing),
                                            frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class ThresholdMapTechnique : public Technique {
 public:
  using Settings = ThresholdMapTechniqueSettings;
  explicit ThresholdMapTechnique(const Settings& settings)
      : settings_(settings.map),
        gpu_(settings.gpu),
        display_(settings.viewing.profile()),
        shaded_(settings.shading) {}

  void prepare(frame::Frame& frame) override {
    map_.emplace(frame.context(), frame.sizePx(), display_, settings_, gpu_);
    frame.passes().setBytesHeld("threshold_map/levels", map_->bytesHeld());
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
            {"gaussian_levels", static_cast<double>(map_->levels())},
            {"pixels_per_degree", display_.pixelsPerDegree()}};
  }

 private:
  perception::ThresholdMapSettings settings_;
  perception::ThresholdMapGpuSettings gpu_;
  perception::DisplayProfile display_;
  frame::ShadedSetting shaded_;
  std::optional<perception::ThresholdMapGpu> map_;
};

const RegisteredTechnique<ThresholdMapTechnique> kThresholdMapRegistered{
    {.name = "perception/threshold_map",
     .version = 2,
     .summary = "Single threshold map of the shaded frame, on the GPU; differences below it may be visible",
     .source = "Schwarz 2009, section 9.4 (SP-30, SP-31)",
     .product = ProductKind::Threshold,
     .counters = {{"bytes_moved_per_px", "Bytes moved per pixel", "byte", Direction::LowerIsBetter},
                  {"gaussian_levels", "Levels of the Gaussian pyramid", "", Direction::Neither},
                  {"pixels_per_degree", "Pixels per degree", "px/deg", Direction::Neither}}}};

}  // namespace
}  // namespace limen::techniques
