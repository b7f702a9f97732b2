// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/weight_settings.h"

namespace limen::perception {
namespace {

constexpr const char* kNotGiven = "choice";
constexpr const char* kToleranceText = "relative difference of depth within one surface";

}  // namespace

const SettingsTable<DisocclusionSettings>& DisocclusionSettings::table() {
  using S = DisocclusionSettings;
  static const SettingsTable<S> kTable = {
      Binding(&S::outsideVisibility, "outside_visibility", Range{0.0, 1.0}, "",
              "visibility of points that were outside the previous frame", kNotGiven)
          .formerly({"outside_visibility"}),
      Binding(&S::pcfRadiusPx, "pcf_radius_px", Range{0, 8}, "px",
              "radius of the previous depth comparison; 0: the four nearest texels", kNotGiven)
          .formerly({"pcf_radius_px"}),
      Binding(&S::depthTolerance, "depth_tolerance", Range{0.0, 1.0}, "", kToleranceText, kNotGiven)
          .formerly({"depth_tolerance"})};
  return kTable;
}

const SettingsTable<FlickerSettings>& FlickerSettings::table() {
  using S = FlickerSettings;
  static const SettingsTable<S> kTable = {
      Binding(&S::kappa, "kappa", Range{0.0, 10.0}, "",
              "colour difference over time, relative to that between the levels of detail, that counts as "
              "flicker",
              kNotGiven)
          .formerly({"flicker_kappa"}),
      Binding(&S::maxDisplacementPx, "max_displacement_px", Range{0.0, 1e4}, "px",
              "displacement from which nothing counts as flicker", kNotGiven)
          .formerly({"flicker_max_displacement_px"}),
      Binding(&S::weight, "weight", Range{0.0, 1.0}, "", "weight of a flickering pixel", kNotGiven)
          .formerly({"flicker_weight"}),
      Binding(&S::depthTolerance, "depth_tolerance", Range{0.0, 1.0}, "", kToleranceText, kNotGiven)
          .formerly({"depth_tolerance"})};
  return kTable;
}

}  // namespace limen::perception
