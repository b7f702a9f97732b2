// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "renderer/techniques/antialiasing/sample_view.h"

namespace limen::techniques {

/// Terms in which a window's depths are compared; the thesis does not say.
enum class DepthTerms {
  Relative,  ///< distances along the view over that of the first sample: the same at any scale
  Linear,    ///< distances along the view, in the scene's unit
  Window     ///< near / distance, as a depth buffer with reversed depth stores them
};
constexpr EnumNames<DepthTerms, 3> enumNames(DepthTerms) {
  return {
      {{{DepthTerms::Relative, "relative"}, {DepthTerms::Linear, "linear"}, {DepthTerms::Window, "window"}}}};
}

enum class MetricForm {
  Stable,  ///< without cancellation
  Printed  ///< as the thesis prints the formulas
};
constexpr EnumNames<MetricForm, 2> enumNames(MetricForm) {
  return {{{{MetricForm::Stable, "stable"}, {MetricForm::Printed, "printed"}}}};
}

struct NoGeometry {
  static constexpr const char *kKind = "none", *kSummary = "geometry asks for no samples";
};
struct MinMaxDepth {
  static constexpr const char *kKind = "min_max_depth", *kSummary = "range of depths (MM)";
  double depthScale = 1000.0;
  DepthTerms depth = DepthTerms::Relative;
  static const SettingsTable<MinMaxDepth>& table();
};
struct NormalCone {
  static constexpr const char *kKind = "normal_cone", *kSummary = "cone of normals around their mean (NC)";
  double normalScale = 300.0;
  MetricForm form = MetricForm::Stable;
  static const SettingsTable<NormalCone>& table();
};
struct DepthVariance {
  static constexpr const char *kKind = "depth_variance", *kSummary = "variance of depths (DV)";
  double depthScale = 1e6;
  DepthTerms depth = DepthTerms::Relative;
  MetricForm form = MetricForm::Stable;
  static const SettingsTable<DepthVariance>& table();
};
struct NormalVariance {
  static constexpr const char *kKind = "normal_variance",
                              *kSummary = "deviation of normals from their mean (NV)";
  double normalScale = 1000.0;
  MetricForm form = MetricForm::Stable;
  static const SettingsTable<NormalVariance>& table();
};
struct NormalAndDepth {
  static constexpr const char *kKind = "normal_and_depth", *kSummary = "the larger of NC and DV (ND)";
  double normalScale = 300.0, depthScale = 1e6;
  DepthTerms depth = DepthTerms::Relative;
  MetricForm form = MetricForm::Stable;
  static const SettingsTable<NormalAndDepth>& table();
};

struct NoLightness {
  static constexpr const char *kKind = "none", *kSummary = "light asks for no samples";
};
struct LightnessRange {
  static constexpr const char
      *kKind = "luminance_range",
      *kSummary = "range of luminance of the first samples of a pixel and its four neighbours";
  double scale = 100.0, leastRange = 1.0 / 32.0, edgeShare = 0.05;
  static const SettingsTable<LightnessRange>& table();
};

/// Which pixels an invocation shades.
enum class SampleExecution { Loop, Grouped, Sorted, Balanced };
constexpr EnumNames<SampleExecution, 4> enumNames(SampleExecution) {
  return {{{{SampleExecution::Loop, "loop"},
            {SampleExecution::Grouped, "grouped"},
            {SampleExecution::Sorted, "sorted"},
            {SampleExecution::Balanced, "balanced"}}}};
}

struct AdaptiveSettings {
  int window = 4;
  std::variant<NormalAndDepth, MinMaxDepth, NormalCone, DepthVariance, NormalVariance, NoGeometry> geometry;
  std::variant<LightnessRange, NoLightness> lightness;
  bool flatTriangles = true;
  bool powersOfTwo = false;
  int block = 1;
  SampleExecution execution = SampleExecution::Sorted;
  SampleGradients gradients;
  SampleShading samples;
  static const SettingsTable<AdaptiveSettings>& table();
};

}  // namespace limen::techniques
