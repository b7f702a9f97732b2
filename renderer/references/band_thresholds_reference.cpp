// SPDX-License-Identifier: BSD-3-Clause
// Thresholds by frequency band of the shaded frame in double precision on the CPU, without tables of the
// GPU's kind. Exact except for the frame itself, which the GPU shades.
#include <optional>

#include "perception/band_thresholds/reference.h"
#include "perception/threshold_maps/reference.h"
#include "perception/threshold_maps/viewing.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/technique.h"

namespace limen::references {
namespace {

using techniques::Counter;

struct BandThresholdReferenceSettings {
  perception::BandThresholdSettings map;
  perception::ViewingSettings viewing;
  frame::ShadedSetting shading;
  static const SettingsTable<BandThresholdReferenceSettings>& table() {
    using S = BandThresholdReferenceSettings;
    static const SettingsTable<S> kTable = {
        {&S::map, "map", "The model"}, included(&S::viewing), frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class BandThresholdReference : public techniques::Technique {
 public:
  using Settings = BandThresholdReferenceSettings;
  explicit BandThresholdReference(const Settings& settings)
      : settings_(settings.map), display_(settings.viewing.profile()), shaded_(settings.shading) {}

  void prepare(frame::Frame& frame) override {
    product_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld("band_thresholds_reference", product_->bytes());
  }

  void render(frame::Frame& frame) override {
    const Image shaded = frame.get<frame::Shaded>(shaded_).texture().read();
    const auto scope = frame.passes().open("band_thresholds_reference");
    const perception::BandThresholds thresholds =
        perception::computeBandThresholds(perception::luminancePlane(shaded, display_), display_, settings_);
    guarded_ = thresholds.guarded;
    product_->write(perception::toImage(perception::thresholdMapOf(thresholds, settings_)));
  }

  const gl::Texture& product() const override { return *product_; }

  std::vector<Counter> count(frame::Frame&) override {
    return {{"guarded_contrasts", static_cast<double>(guarded_)},
            {"pixels_per_degree", display_.pixelsPerDegree()}};
  }

 private:
  perception::BandThresholdSettings settings_;
  perception::DisplayProfile display_;
  frame::ShadedSetting shaded_;
  int64_t guarded_ = 0;
  std::optional<gl::Texture> product_;
};

const techniques::RegisteredTechnique<BandThresholdReference> kBandThresholdReferenceRegistered{
    {.name = "perception/band_thresholds_reference",
     .version = 1,
     .summary = "Thresholds by frequency band in double precision",
     .source = "inverse of the predictor of Schwarz 2009, section 10.3",
     .product = techniques::ProductKind::Threshold,
     .reference = true,
     .onCpu = true,
     .counters = {{"guarded_contrasts", "Contrasts with a bounded denominator", "", Direction::Neither},
                  {"pixels_per_degree", "Pixels per degree", "px/deg", Direction::Neither}}}};

}  // namespace
}  // namespace limen::references
