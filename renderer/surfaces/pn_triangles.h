// SPDX-License-Identifier: BSD-3-Clause
// Curved point-normal triangles and Phong tessellation (Schwarz 2009, section 6.1.3; Vlachos et al. 2001;
// Boubekeur and Alexa 2008; SC-07 to SC-10, SC-14): patches made from a triangle's corners and normals alone.
#pragma once

#include <array>
#include <optional>

#include "renderer/surfaces/patch_set.h"

namespace limen::surfaces {

/// Middle control point of the normal field over an edge. With S the sum of the ends' normals, E the edge,
/// q = <S, E> / |E|^2 and h = S - 2 q E. Where the formula gives no direction (opposed normals, no edge), the
/// field is linear there.
enum class PnNormals {
  Linear,             ///< S / 2
  Vlachos,            ///< h / |h|
  VanOverveldWyvill,  ///< (S - 3 q E) / 2
  Farin,              ///< 3 h / 2 - S / 4
  CorrectedFarin,     ///< 2 h - S / 2: the field is h in the middle of the edge
  /// Vlachos where the edge's curve has an inflection, that is, where both normals lean towards the same end;
  /// otherwise linear. The thesis names the heuristic and gives no formula; this is ours.
  LeeJen
};

struct PnSettings {
  PnNormals normals = PnNormals::Linear;
  /// h / 2 in place of h for Farin and CorrectedFarin: a flat triangle then has the same normal everywhere,
  /// where the printed formulae weight the middle of its edges 2.5 and 3 times as much as its corners.
  bool halfH = false;
  /// Shortens tangents: tangent points lie at (1 - tension) of their way from the corner. 0: PN triangles.
  double tension = 0.0;
};

struct PnTriangle {
  std::array<glm::dvec3, 10> points;  ///< b300, b210, b201, b120, b111, b102, b030, b021, b012, b003
  std::array<glm::dvec3, 6> normals;  ///< n200, n110, n101, n020, n011, n002; corners unit
};

/// Corners of a triangle, counter-clockwise, with unit normals.
struct PnBase {
  std::array<glm::dvec3, 3> positions, normals;
  /// For side s, which runs from corner s to s + 1, the normals that the neighbouring triangle has at the
  /// side's two ends, where they differ: the boundary then follows the crease (SC-08).
  std::array<std::array<std::optional<glm::dvec3>, 2>, 3> creases{};
};

/// Control points. Sides depend on their ends alone, bit by bit: neighbours that share corners and normals,
/// or know of the crease between them, share their boundary.
PnTriangle pnTriangle(const PnBase& base, const PnSettings& settings = {});

/// Middle control point of the normals over the edge from a to b; see PnNormals.
glm::dvec3 pnMiddleNormal(glm::dvec3 a, glm::dvec3 b, glm::dvec3 normalA, glm::dvec3 normalB,
                          const PnSettings& settings);

/// Largest distance of the six tangent control points from the edges they belong to (section 7.4.5).
double pnTangentDistance(const PnTriangle& triangle);

/// Phong tessellation as a quadratic triangle, corners and middles in the order of PnTriangle::normals: the
/// point at (u, v, w) is the flat one moved by `alpha` towards the barycentric mean of its projections onto
/// the corners' tangent planes. alpha = 0: flat; 3/4 is recommended by its authors.
std::array<glm::dvec3, 6> phongTriangle(const PnBase& base, double alpha);

}  // namespace limen::surfaces
