// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/surfaces/patch_motion.h"
#include "renderer/surfaces/trim_region.h"

namespace limen::surfaces {

/// Parameter domain of a patch. Corners and sides are numbered counter-clockwise in the domain; side s runs
/// from corner s to corner s + 1.
enum class Domain : uint8_t {
  Rectangle,  ///< (u, v) in [0,1]^2; corners (0,0), (1,0), (1,1), (0,1); sides v = 0, u = 1, v = 1, u = 0
  Triangle    ///< u, v, w = 1 - u - v >= 0; corners u = 1, v = 1, w = 1; sides w = 0, u = 0, v = 0
};

constexpr int sidesOf(Domain domain) { return domain == Domain::Rectangle ? 4 : 3; }

inline constexpr int kMaxDegree = 9;

/// Which side of which patch lies along a side.
struct Neighbour {
  int32_t patch = -1;  ///< -1: none
  int32_t side = 0;
  bool reversed = true;  ///< the neighbour's side runs the other way, as where both are oriented alike
};

/// A polynomial or rational Bézier patch: a run of control points in PatchSet::points.
/// Rectangle: point (i, j) is at firstPoint + i + (degreeU + 1) j; i goes with u. Triangle of degree n: point
/// (i, j, k), i + j + k = n, which goes with u^i v^j w^k, is at firstPoint + (n - i)(n - i + 1) / 2 + k.
/// (Schwarz 2009, section 6.1.)
struct Patch {
  Domain domain = Domain::Rectangle;
  uint8_t degreeU = 3, degreeV = 3;  ///< 1..kMaxDegree; of a triangle both are its degree
  /// Of the normal field: of a triangle (PN triangles) 1 or 2, of a rectangle 5 along both directions; 0:
  /// normals come from the geometry.
  uint8_t normalDegree = 0;
  uint32_t firstPoint = 0;
  uint32_t firstNormal = 0;  ///< in PatchSet::normals, if normalDegree > 0; in the order of points
  uint32_t part = 0;         ///< of Scene::parts

  int points() const {
    return domain == Domain::Rectangle ? (degreeU + 1) * (degreeV + 1) : (degreeU + 1) * (degreeU + 2) / 2;
  }
  int normals() const {
    if (normalDegree == 0) return 0;
    return (normalDegree + 1) * (domain == Domain::Rectangle ? normalDegree + 1 : normalDegree + 2) /
           (domain == Domain::Rectangle ? 1 : 2);
  }
};

/// Which region is left of a rectangle, and the part of the region's unit square that the patch covers.
struct PatchTrim {
  int32_t region = -1;  ///< of PatchSet::trims; -1: all is left
  glm::dvec2 low{0.0}, high{1.0};
};

/// Curved surfaces of a scene, as patches that know their neighbours.
struct PatchSet {
  /// Homogeneous: (w x, w y, w z, w), world units; w = 0 gives a direction (x, y, z, 0).
  std::vector<glm::dvec4> points;
  std::vector<glm::dvec3> normals;  ///< need not be unit
  std::vector<Patch> patches;
  std::vector<std::array<Neighbour, 4>> neighbours;  ///< one per patch; by side
  std::vector<TrimRegion> trims;
  std::vector<PatchTrim> trimOf;  ///< empty, or one per patch
  PatchMotion motion;

  bool empty() const { return patches.empty(); }
};

}  // namespace limen::surfaces
