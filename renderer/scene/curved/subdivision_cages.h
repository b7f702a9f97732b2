// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/enum_names.h"
#include "renderer/surfaces/polygon_mesh.h"
#include "renderer/surfaces/subdivision_surface.h"

namespace limen::scene {

/// Closed cages, of quads but for the last.
enum class CageShape {
  DoubleTorus,    ///< 48 quads
  Block,          ///< six, whose vertices have valence 3
  CreasedBlock,   ///< with sharp edges around its top and its bottom
  CorneredBlock,  ///< with two upright ones as well, whose ends are corners
  House           ///< a pentagon below, walls of quads, and a roof of triangles
};
constexpr EnumNames<CageShape, 5> enumNames(CageShape) {
  return {{{{CageShape::Block, "block"},
            {CageShape::CorneredBlock, "cornered_block"},
            {CageShape::CreasedBlock, "creased_block"},
            {CageShape::DoubleTorus, "double_torus"},
            {CageShape::House, "house"}}}};
}
/// Upright: y is up.
surfaces::PolygonMesh closedCage(CageShape shape);

/// Two pyramids, tip up and tip down: two vertices of the valence, numbers 0 and 1, all others of valence 4;
/// somewhat uneven.
surfaces::PolygonMesh pyramids(uint32_t valence);
surfaces::PolygonMesh tetrahedron();
/// Open, standing; triangles, or quads.
surfaces::PolygonMesh bumpySheet(uint32_t side, bool quads);
/// Triangles around a vertex of the boundary, which is number 0.
surfaces::PolygonMesh openFan(uint32_t faces);
/// A ring, standing, with texture coordinates from 0 to 1 around it and along it, which end at two seams that
/// cross, and its height as the third attribute, which has no seam of its own. Quads, or triangles.
surfaces::SubdivisionSurface seamedRing(bool quads);

}  // namespace limen::scene
