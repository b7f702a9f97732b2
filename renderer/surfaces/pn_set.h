// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/corner_normals.h"
#include "renderer/surfaces/pn_triangles.h"

namespace limen::surfaces {

struct PnSetSettings {
  PnSettings patch;
  /// Where triangles have different normals at the ends of their common edge, the boundary follows the
  /// crease. Otherwise each triangle has a boundary of its own there, and the surface has a gap.
  bool creases = true;
};

/// What pnTriangle() takes of each triangle of a mesh with merged positions and corner normals.
std::vector<PnBase> pnBases(const BaseMesh& mesh, bool creases = true);

/// One cubic triangle with a quadratic normal field for each triangle of a mesh with merged positions and
/// corner normals. Neighbours are found. (Schwarz 2009, section 6.1.3; SC-07 to SC-10)
PatchSet pnSet(const BaseMesh& mesh, const PnSetSettings& settings = {});

/// Phong tessellation: quadratic triangles with linear normals (SC-14); see phongTriangle().
PatchSet phongSet(const BaseMesh& mesh, double alpha);

}  // namespace limen::surfaces
