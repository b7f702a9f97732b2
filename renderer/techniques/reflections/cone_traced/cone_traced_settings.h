// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/enum_names.h"
#include "experiments/base/settings_table.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/reflections/ray_hierarchy/traversal_settings.h"

namespace limen::techniques {

enum class ConeReflection { Paraxial, EdgeRays };
constexpr EnumNames<ConeReflection, 2> enumNames(ConeReflection) {
  return {{{{ConeReflection::Paraxial, "paraxial"}, {ConeReflection::EdgeRays, "edge_rays"}}}};
}
enum class ConeContribution { Area, Table };
constexpr EnumNames<ConeContribution, 2> enumNames(ConeContribution) {
  return {{{{ConeContribution::Area, "area"}, {ConeContribution::Table, "table"}}}};
}
enum class ConeCoverage { Saturated, Masked };
constexpr EnumNames<ConeCoverage, 2> enumNames(ConeCoverage) {
  return {{{{ConeCoverage::Saturated, "saturated"}, {ConeCoverage::Masked, "masked"}}}};
}

/// What a cone shows where no triangle that was kept covers it.
struct FillNothing {
  static constexpr const char *kKind = "nothing", *kSummary = "black";
  static const SettingsTable<FillNothing>& table();
};
struct FillBackground {
  static constexpr const char *kKind = "background", *kSummary = "the background's colour";
  static const SettingsTable<FillBackground>& table();
};
struct FillRescaled {
  static constexpr const char *kKind = "rescaled", *kSummary = "the mean of what covers the rest of the cone";
  static const SettingsTable<FillRescaled>& table();
};
struct FillEnvironment {
  static constexpr const char *kKind = "environment",
                              *kSummary = "a small cube map from the middle of the mirror";
  int resolution = 32;
  static const SettingsTable<FillEnvironment>& table();
};
using ConeFill = std::variant<FillBackground, FillNothing, FillRescaled, FillEnvironment>;

/// Order in which a pixel's triangles are blended.
struct SortedLayers {
  static constexpr const char *kKind = "sorted",
                              *kSummary = "the nearest ones of a list, sorted by each pixel";
  static const SettingsTable<SortedLayers>& table();
};
struct PeeledLayers {
  static constexpr const char *kKind = "peeled",
                              *kSummary = "points drawn again for each layer, with a depth test";
  int room = 4194304;
  static const SettingsTable<PeeledLayers>& table();
};
using ConeLayers = std::variant<SortedLayers, PeeledLayers>;

struct ConeTracedSettings {
  double glossScale = 1.0;
  ConeReflection reflection = ConeReflection::EdgeRays;
  int layers = 20;
  double leastShare = 0.0;
  ConeContribution contribution = ConeContribution::Area;
  ConeCoverage coverage = ConeCoverage::Saturated;
  ConeFill fill;
  ConeLayers backEnd;
  double farRadius = 0.0;
  bool filterPatterns = true;
  TraversalSettings traversal{.leafSide = 4};
  frame::ShadedSetting shading;
  void check() const;
  static const SettingsTable<ConeTracedSettings>& table();
};

}  // namespace limen::techniques
