// SPDX-License-Identifier: BSD-3-Clause
// Luminance thresholds of the shaded frame, one per pixel:
//
// - bands: the popping predictor inverted. Either the combined map, below which a luminance difference of any
//   frequencies changes no band's response visibly, or one band's thresholds, for differences split into
//   bands.
// - single: the map of Schwarz 2009, section 9.4 (SP-29 to SP-34), taken there for the threshold of
// differences
//   of any frequencies. It lends the masking of one band to all others, so that differences below it may be
//   plainly visible: for comparison. Departures, each a parameter if it changes the map: castleCSF (model:
//   schwarz_2009 for Barten 1989); the kernel, which the thesis leaves open, is the binomial one; the
//   adaptation luminance is blended from two levels so that it is a mean over one degree, whereas the pixels
//   of the nearest level are only about a degree apart; a small contrast is added so that flat regions have
//   an elevation of 1; the stack exists for one tile at a time; 16 bits store bands instead of luminances.
#include <memory>

#include "perception/threshold_maps/viewing.h"
#include "perception/thresholds/thresholds_gpu.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

struct ThresholdMapTechniqueSettings {
  perception::ThresholdGpuSettings thresholds;
  perception::ViewingSettings viewing;
  frame::ShadedSetting shading;
  static const SettingsTable<ThresholdMapTechniqueSettings>& table() {
    using S = ThresholdMapTechniqueSettings;
    static const SettingsTable<S> kTable = {{&S::thresholds, "thresholds", perception::kThresholdsText},
                                            included(&S::viewing),
                                            frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class ThresholdMapTechnique : public Technique {
 public:
  using Settings = ThresholdMapTechniqueSettings;
  explicit ThresholdMapTechnique(const Settings& settings)
      : settings_(settings.thresholds), display_(settings.viewing.profile()), shaded_(settings.shading) {}

  void prepare(frame::Frame& frame) override {
    maker_ = perception::makeThresholds(frame.context(), frame.sizePx(), display_, settings_);
    frame.passes().setBytesHeld(perception::kThresholdLevelsPass, maker_->bytesHeld());
  }

  void render(frame::Frame& frame) override {
    maker_->run(frame.get<frame::Shaded>(shaded_).texture(), &frame.passes());
  }

  const gl::Texture& product() const override { return maker_->map(); }
  std::map<std::string, const gl::Texture*> debugViews() const override { return maker_->debugViews(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const auto bytes = static_cast<double>(maker_->bytesMoved(frame.get<frame::Shaded>(shaded_).texture()));
    const double pixels = double(frame.sizePx().x) * frame.sizePx().y;
    return {{"bytes_moved_per_px", bytes / pixels},
            {"gaussian_levels", static_cast<double>(maker_->levels())},
            {"pixels_per_degree", display_.pixelsPerDegree()}};
  }

 private:
  perception::ThresholdGpuSettings settings_;
  perception::DisplayProfile display_;
  frame::ShadedSetting shaded_;
  std::unique_ptr<perception::ThresholdMaker> maker_;
};

const RegisteredTechnique<ThresholdMapTechnique> kThresholdMapRegistered{
    {.name = "perception/threshold_map",
     .version = 3,
     .summary = "Luminance differences that the predictor does not see, or the thesis's single threshold map",
     .source = "inverse of the predictor of Schwarz 2009, section 10.3; section 9.4 (SP-30, SP-31)",
     .product = ProductKind::Threshold,
     .counters = {{"bytes_moved_per_px", "Bytes moved per pixel", "byte", Direction::LowerIsBetter},
                  {"gaussian_levels", "Levels of the Gaussian pyramid", "", Direction::Neither},
                  {"pixels_per_degree", "Pixels per degree", "px/deg", Direction::Neither}}}};

}  // namespace
}  // namespace limen::techniques
