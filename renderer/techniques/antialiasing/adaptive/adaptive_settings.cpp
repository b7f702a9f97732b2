// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/antialiasing/adaptive/adaptive_settings.h"

#include "renderer/techniques/antialiasing/antialiasing_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kMetrics = "Holländer 2013, section 4.3.1 (value not given there)";

template <class S>
Binding<S> depthScaleBinding(double S::*member) {
  return {member,  "depth_scale", Range{0.0, 1e12}, "", "Further samples per unit of the depth metric",
          kMetrics};
}
template <class S>
Binding<S> normalScaleBinding(double S::*member) {
  return {member,  "normal_scale", Range{0.0, 1e6}, "", "Further samples per unit of the normal metric",
          kMetrics};
}
template <class S>
Binding<S> depthTermsBinding(DepthTerms S::*member) {
  return {
      member, "depth",
      "Depths as shares of the first sample's, in the scene's unit, or as a reversed depth buffer has them"};
}
template <class S>
Binding<S> formBinding(MetricForm S::*member) {
  return {member, "form", "Formulas as printed, or free of cancellation", "Holländer 2013, section 4.3.1"};
}

}  // namespace

const SettingsTable<MinMaxDepth>& MinMaxDepth::table() {
  using S = MinMaxDepth;
  static const SettingsTable<S> kTable = {depthScaleBinding(&S::depthScale), depthTermsBinding(&S::depth)};
  return kTable;
}
const SettingsTable<NormalCone>& NormalCone::table() {
  using S = NormalCone;
  static const SettingsTable<S> kTable = {normalScaleBinding(&S::normalScale), formBinding(&S::form)};
  return kTable;
}
const SettingsTable<DepthVariance>& DepthVariance::table() {
  using S = DepthVariance;
  static const SettingsTable<S> kTable = {depthScaleBinding(&S::depthScale), depthTermsBinding(&S::depth),
                                          formBinding(&S::form)};
  return kTable;
}
const SettingsTable<NormalVariance>& NormalVariance::table() {
  using S = NormalVariance;
  static const SettingsTable<S> kTable = {normalScaleBinding(&S::normalScale), formBinding(&S::form)};
  return kTable;
}
const SettingsTable<NormalAndDepth>& NormalAndDepth::table() {
  using S = NormalAndDepth;
  static const SettingsTable<S> kTable = {normalScaleBinding(&S::normalScale),
                                          depthScaleBinding(&S::depthScale), depthTermsBinding(&S::depth),
                                          formBinding(&S::form)};
  return kTable;
}
const SettingsTable<LightnessRange>& LightnessRange::table() {
  using S = LightnessRange;
  static const SettingsTable<S> kTable = {
      {&S::scale, "scale", {0.0, 1e6}, "", "Further samples per unit of luminance range", kMetrics},
      {&S::leastRange,
       "least_range",
       {0.0, 1.0},
       "",
       "Range of luminance below which light asks for none",
       "Lottes 2009, as cited by Holländer 2013, section 4.3.1"},
      {&S::edgeShare,
       "edge_share",
       {0.0, 1.0},
       "",
       "Range as a share of the largest luminance below which light asks for none",
       "Lottes 2009, as cited by Holländer 2013, section 4.3.1"}};
  return kTable;
}

const SettingsTable<AdaptiveSettings>& AdaptiveSettings::table() {
  using S = AdaptiveSettings;
  static const SettingsTable<S> kTable = {
      {&S::window,
       "window",
       {2, kMostWindow},
       "",
       "Samples per pixel along each axis",
       "Holländer 2013, section 4.3.1"},
      {&S::geometry, "geometry", "Metric of the surfaces in a pixel's window",
       "Holländer 2013, section 4.3.1"},
      {&S::lightness, "lightness", "Metric of the light of pixels' first samples",
       "Holländer 2013, section 4.3.1"},
      {&S::flatTriangles, "flat_triangles",
       "Take normals as equal within a pixel that sees a single triangle, where bends are below a pixel"},
      {&S::powersOfTwo, "powers_of_two", "Round numbers of samples up to powers of two",
       "Holländer 2013, section 4.3.5 (bucketing)"},
      {&S::block,
       "block",
       {1, 16},
       "px",
       "Side of blocks whose pixels all have as many samples as any of them asks for",
       "Holländer 2013, section 4.3.5 (there 6)"},
      {&S::execution, "execution",
       "Shade the further samples in a loop over each pixel's, in a pass for each number of samples, over "
       "pixels sorted "
       "by it, or from a list in each tile",
       "Holländer 2013, section 4.3.5"},
      gradientsBinding(&S::gradients),
      included(&S::samples)};
  return kTable;
}

}  // namespace limen::techniques
