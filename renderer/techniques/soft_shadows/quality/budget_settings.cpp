// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/budget_settings.h"

#include <cmath>

#include "experiments/base/error.h"
#include "perception/vision/display.h"

namespace limen::techniques {
namespace {

constexpr Range kBudgets{1, 1 << 24};
constexpr const char *kOpenContrast = "Schwarz 2009, section 5.2.3 (open there)",
                     *kOpenError = "Schwarz 2009, section 5.2.1 (open there)",
                     *kOpenTime = "Schwarz 2009, chapter 5 (open there)",
                     *kRadialSource = "Schwarz 2009, figure 5.5 d";

void checkRange(const BudgetRange& range, const char* least, const char* most) {
  if (range.least > range.most)
    throw Error("'" + std::string(least) + "' is above '" + most + "', the largest number per pixel", least,
                "give it a smaller number, or '" + std::string(most) + "' a larger one");
}

int64_t mostIn(const UniformBudget& budget) { return budget.limit; }
int64_t mostIn(const ScaledBudget& budget) { return budget.limit; }
int64_t mostIn(const RadialBudget& budget) { return budget.centre; }
int64_t mostIn(const FrameTimeBudget& budget) { return budget.range().most; }
template <class B>
int64_t mostIn(const B& budget) {
  return budget.range().most;
}

}  // namespace

float BudgetRange::leastRoot() const { return static_cast<float>(std::sqrt(static_cast<double>(least))); }
float BudgetRange::mostRoot() const { return static_cast<float>(std::sqrt(static_cast<double>(most))); }

const SettingsTable<UniformBudget>& UniformBudget::table() {
  static const SettingsTable<UniformBudget> kTable = {
      {&UniformBudget::limit,
       "limit",
       {0, 1 << 24},
       "",
       "Micro-occluders allowed per pixel; the square root is the number per axis; 0: no limit",
       "Schwarz 2009, sections 4.1 and 4.5"}};
  return kTable;
}

const SettingsTable<RadialBudget>& RadialBudget::table() {
  using S = RadialBudget;
  static const SettingsTable<S> kTable = {
      {&S::centre, "centre", kBudgets, "", "Micro-occluders allowed per pixel in the centre", kRadialSource},
      Binding(&S::rim, "rim", kBudgets, "", "Micro-occluders allowed per pixel at the rim", kRadialSource)
          .formerly({"radial_budget"}),
      Binding(&S::centreX, "centre_x", Range{0.0, 1.0}, "", "Centre, as a share of the image's width")
          .formerly({"radial_centre_x"}),
      Binding(&S::centreY, "centre_y", Range{0.0, 1.0}, "",
              "Centre, as a share of the image's height from its top")
          .formerly({"radial_centre_y"}),
      Binding(&S::inner, "inner", Range{0.0, 10.0}, "half width",
              "Distance from the centre up to which the full budget is allowed")
          .formerly({"radial_inner"}),
      Binding(&S::outer, "outer", Range{0.001, 10.0}, "half width",
              "Distance from the centre at which the rim's budget is reached", kRadialSource)
          .formerly({"radial_outer"})};
  return kTable;
}

void RadialBudget::check() const {
  if (inner >= outer)
    throw Error("the rim at 'outer' lies within 'inner'", "outer", "give it a larger radius than 'inner'");
}

const SettingsTable<MaskingBudget>& MaskingBudget::table() {
  using S = MaskingBudget;
  static const SettingsTable<S> kTable = {
      {&S::plain, "plain", kBudgets, "", "Micro-occluders allowed per pixel of a plain surface",
       "Schwarz 2009, figure 5.4"},
      Binding(&S::masked, "masked", kBudgets, "",
              "Micro-occluders allowed per pixel where texture masks most", "Schwarz 2009, figure 5.4")
          .formerly({"masking_budget"}),
      Binding(&S::radius, "radius", Range{1, 64}, "px",
              "Radius of the square window in which contrast is measured", kOpenContrast)
          .formerly({"masking_radius"}),
      Binding(&S::lowContrast, "low_contrast", Range{0.0, 10.0}, "",
              "RMS contrast up to which 'plain' applies", kOpenContrast)
          .formerly({"masking_low_contrast"}),
      Binding(&S::highContrast, "high_contrast", Range{0.0, 10.0}, "",
              "RMS contrast from which 'masked' applies", kOpenContrast)
          .formerly({"masking_high_contrast"})};
  return kTable;
}

void MaskingBudget::check() const {
  checkRange(range(), "masked", "plain");
  if (lowContrast >= highContrast)
    throw Error("'high_contrast' is not above 'low_contrast'", "high_contrast",
                "give it a larger contrast than 'low_contrast'");
}

const SettingsTable<PaintedBudget>& PaintedBudget::table() {
  using S = PaintedBudget;
  static const SettingsTable<S> kTable = {
      Binding(&S::file, "file", FileIs::Required,
              "Image of weights: greys as stored, without a transfer curve")
          .formerly({"painted_file"}),
      {&S::white, "white", kBudgets, "", "Micro-occluders allowed per pixel where the image is white",
       "Schwarz 2009, section 5.2.1"},
      Binding(&S::black, "black", kBudgets, "", "Micro-occluders allowed per pixel where the image is black",
              "Schwarz 2009, section 5.2.1")
          .formerly({"painted_budget"}),
      Binding(&S::fit, "fit",
              "If the image's aspect ratio differs from the frame's: an error, stretched, or cropped to "
              "cover the frame")
          .formerly({"painted_fit"})};
  return kTable;
}

void PaintedBudget::check() const { checkRange(range(), "black", "white"); }

const SettingsTable<PerceptualBudget>& PerceptualBudget::table() {
  using S = PerceptualBudget;
  static const SettingsTable<S> kTable = {
      {&S::most, "most", kBudgets, "", "Micro-occluders allowed per pixel where errors are most visible",
       kOpenError},
      Binding(&S::least, "least", kBudgets, "",
              "Micro-occluders allowed per pixel where errors are least visible", kOpenError)
          .formerly({"perceptual_budget"}),
      Binding(
          &S::thresholdMap, "threshold_map",
          "Threshold map: a single one, below which errors may be visible; the one combined from frequency "
          "bands by the predictor; or the single one with the settings of Schwarz 2009, section 9.4",
          kOpenError)
          .formerly({"map"}),
      Binding(&S::error, "error", Range{0.0, 16.0}, "",
              "Error of the visibility with one micro-occluder per axis (c); with r per axis it is c / r",
              kOpenError)
          .formerly({"perceptual_error"}),
      Binding(&S::thresholds, "thresholds", Range{0.01, 1000.0}, "threshold",
              "Multiple of the visible increment that errors may reach", kOpenError)
          .formerly({"perceptual_thresholds"}),
      Binding(&S::display, "display", Names{perception::displayPresets()},
              "Display and viewing distance to which the budget applies", "Schwarz 2009, section 10.4.1")
          .formerly({"perceptual_display"}),
      Binding(&S::ambient, "ambient", Range{0.0, 1.0}, "",
              "Ambient share of the albedo, for the threshold map")
          .formerly({"perceptual_ambient"}),
      Binding(&S::diffuse, "diffuse", Range{0.0, 1.0}, "",
              "Share of the albedo times the cosine towards the light: the part multiplied by the visibility")
          .formerly({"perceptual_diffuse"})};
  return kTable;
}

void PerceptualBudget::check() const { checkRange(range(), "least", "most"); }

const SettingsTable<ScaledBudget>& ScaledBudget::table() {
  static const SettingsTable<ScaledBudget> kTable = {
      {&ScaledBudget::limit, "limit", kBudgets, "", "Micro-occluders allowed per pixel at a scale of 1"}};
  return kTable;
}

const SettingsTable<FrameTimeBudget>& FrameTimeBudget::table() {
  using S = FrameTimeBudget;
  static const SettingsTable<S> kTable = {
      Binding(&S::targetMs, "target_ms", Range{1e-9, 1e9}, "ms",
              "Target time of the technique's passes that depend on the budget", kOpenTime)
          .formerly({"frame_time_ms"}),
      Binding(&S::least, "least", kBudgets, "",
              "Smallest number of micro-occluders allowed per pixel, however long a frame takes", kOpenTime)
          .formerly({"frame_time_budget"}),
      Binding(&S::base, "base", "Budget that is scaled").shorthand("limit").formerly({"frame_time_base"}),
      Binding(&S::gain, "gain", Range{0.01, 1.0}, "",
              "Share applied of the change that a frame's time calls for", kOpenTime)
          .formerly({"frame_time_gain"}),
      Binding(&S::deadBand, "dead_band", Range{0.0, 1.0}, "",
              "Error of the time, relative to the target, that is tolerated", kOpenTime)
          .formerly({"frame_time_dead_band"}),
      Binding(&S::memory, "memory", Range{2, 4096}, "frames",
              "Past frames to which the fixed part of the cost is fitted", kOpenTime)
          .formerly({"frame_time_memory"}),
      Binding(&S::largestFactor, "largest_factor", Range{1.01, 1000.0}, "",
              "Largest change of the scale that one frame can call for", kOpenTime)
          .formerly({"frame_time_largest_factor"}),
      Binding(&S::dither, "dither",
              "Give pixels one of the two whole counts per axis around the scaled one, in proportion; "
              "otherwise all get the smaller one")
          .formerly({"frame_time_dither"}),
      Binding(&S::settleFrames, "settle_frames", Range{0, 4096}, "frames",
              "Frames that run before the first one shown or timed, as part of the preparation")
          .formerly({"frame_time_settle_frames"})};
  return kTable;
}

BudgetRange FrameTimeBudget::range() const {
  return {least, std::visit([](const auto& chosen) { return mostIn(chosen); }, base)};
}

void FrameTimeBudget::check() const {
  const BudgetRange between = range();
  if (between.least > between.most)
    throw Error("'least' is above the largest number that the base allows", "least",
                "give it a smaller number, or the base a larger one");
}

int64_t mostOf(const BudgetSettings& budget) {
  return std::visit([](const auto& chosen) { return mostIn(chosen); }, budget);
}

}  // namespace limen::techniques
