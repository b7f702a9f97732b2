// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/surfaces/subdivision_stencils.h"
#include "renderer/techniques/subdivision/fragments/fragment_bindings.h"

namespace limen::techniques {

/// The quads of a refined control mesh, each with the vertices around it: patches of Bunnell 2005, fragment
/// meshes of Shiue, Jones and Peters 2005.
struct FragmentLayout {
  std::vector<FragmentRecord> fragments;
  /// By fragment: the vertices of its grid of one segment, 4 a row, then of its ring, 16 + ringPoints in all.
  std::vector<uint32_t> controls;
  uint32_t ringPoints = 0;  ///< that are kept for a ring: twice the edges of the largest, at least 8
};

/// Whether no quad has more than one vertex that is extraordinary or that sharp edges meet at other than by
/// passing straight along the quad's side; a step of subdivision more separates those.
bool isSeparated(const surfaces::RuleMesh& mesh);

/// Throws Error if the mesh is not separated, a crease ends inside the surface or a vertex has more edges
/// than kFragmentMostEdges.
FragmentLayout fragmentLayout(const surfaces::RuleMesh& mesh, uint32_t material);

}  // namespace limen::techniques
