// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/settings_table.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/reflections/vertex_reflection/secant_solver.h"
#include "renderer/techniques/reflections/vertex_reflection/star_map.h"

namespace limen::techniques {

/// Where reflection points are found.
enum class Placement {
  Compute,      ///< before drawing, once a vertex
  VertexShader  ///< while drawing, by the driver's vertex processing
};
constexpr EnumNames<Placement, 2> enumNames(Placement) {
  return {{{{Placement::Compute, "compute"}, {Placement::VertexShader, "vertex_shader"}}}};
}

/// Triangles of which a corner has no reflection.
enum class InvalidPolicy {
  Drop,      ///< are not drawn
  Clamp,     ///< keep the best sample found for the corner
  Subdivide  ///< are divided as finely as allowed; what still has such a corner is not drawn
};
constexpr EnumNames<InvalidPolicy, 3> enumNames(InvalidPolicy) {
  return {{{{InvalidPolicy::Drop, "drop"},
            {InvalidPolicy::Clamp, "clamp"},
            {InvalidPolicy::Subdivide, "subdivide"}}}};
}

/// Depth of reflected fragments.
enum class PathDepth {
  Vertices,  ///< path lengths of the corners, interpolated
  Fragments  ///< distance between the interpolated points
};
constexpr EnumNames<PathDepth, 2> enumNames(PathDepth) {
  return {{{{PathDepth::Vertices, "vertices"}, {PathDepth::Fragments, "fragments"}}}};
}

/// From where reflected surfaces are lit.
enum class LitFrom { Mirror, Eye };
constexpr EnumNames<LitFrom, 2> enumNames(LitFrom) {
  return {{{{LitFrom::Mirror, "mirror"}, {LitFrom::Eye, "eye"}}}};
}

enum class MapFormat { Rgba32f, Rgba16f };
constexpr EnumNames<MapFormat, 2> enumNames(MapFormat) {
  return {{{{MapFormat::Rgba32f, "rgba32f"}, {MapFormat::Rgba16f, "rgba16f"}}}};
}

struct ReflectorMapSettings {
  reflections::MapLayout layout = reflections::MapLayout::Cube;
  int resolution = 128;
  MapFormat format = MapFormat::Rgba32f;
  bool filter = true;
  static const SettingsTable<ReflectorMapSettings>& table();
};

struct SecantSettings {
  reflections::GradientForm gradient = reflections::GradientForm::Corrected;
  reflections::FirstGuess guess = reflections::FirstGuess::FacingEye;
  reflections::Safeguard safeguard = reflections::Safeguard::Restart;
  int cap = 20;
  reflections::StopMeasure stop = reflections::StopMeasure::LongestSide;
  double stopAreaPx2 = 1e-4;
  double determinantShare = 1e-12;
  double leastSide = 0.05;
  double falseRootLength = 1e-3;
  static const SettingsTable<SecantSettings>& table();
  /// For the solver in double precision.
  reflections::SolverSettings onCpu() const;
};

struct EvenSegments {
  static constexpr const char *kKind = "even", *kSummary = "every triangle alike, before the first frame";
  int segments = 1;
  static const SettingsTable<EvenSegments>& table();
};
struct AdaptiveSegments {
  static constexpr const char *kKind = "adaptive",
                              *kSummary = "by the driver's tessellation stages, as reflected edges bend";
  int segments = 1;
  double tolerancePx = 0.5;
  int most = 16;
  static const SettingsTable<AdaptiveSegments>& table();
};

struct NoSurroundings {
  static constexpr const char *kKind = "none", *kSummary = "all of the scene is reflected vertex by vertex";
};
struct FarSurroundings {
  static constexpr const char *kKind = "environment",
                              *kSummary = "beyond a distance the scene comes from an environment map";
  double distance = 4.0, blend = 0.25;
  int resolution = 256;
  static const SettingsTable<FarSurroundings>& table();
};

struct VertexReflectionSettings {
  Placement placement = Placement::Compute;
  ReflectorMapSettings map;
  SecantSettings solver;
  std::variant<EvenSegments, AdaptiveSegments> tessellation = AdaptiveSegments{};
  std::variant<NoSurroundings, FarSurroundings> surroundings;
  InvalidPolicy invalid = InvalidPolicy::Subdivide;
  PathDepth depth = PathDepth::Vertices;
  bool hideBehindBacks = true;
  double backSlack = 0.0;
  LitFrom litFrom = LitFrom::Mirror;
  frame::ShadedSetting shading;
  static const SettingsTable<VertexReflectionSettings>& table();
  void check() const;
};

}  // namespace limen::techniques
