// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/base/enum_names.h"
#include "renderer/scene/lod_set.h"

namespace limen::scene {

/// What becomes of the normals of the vertices that a coarser level keeps.
enum class ChainNormals {
  Kept,  ///< the finest level's, as progressive meshes carry attributes along
  Own    ///< worked out anew from the level's triangles
};
constexpr EnumNames<ChainNormals, 2> enumNames(ChainNormals) {
  return {{{{ChainNormals::Kept, "kept"}, {ChainNormals::Own, "own"}}}};
}

/// Levels of a triangle mesh by collapsing edges, each level from the one before as in a progressive mesh
/// (Schwarz 2009, section 10.3.5): level 0 is the mesh, level i keeps about `keptShares[i - 1]` of its
/// triangles (descending shares; fewer may go where the surface's topology forbids more). Levels that come
/// out no smaller than the one before are left out, so there may be fewer than asked for.
///
/// deviation: sampledDeviation() from the mesh. statedError: the sum of meshoptimizer's errors of the steps
/// so far: each the square root of a quadric, an estimate of the distance to the planes of the step's
/// triangles. Morph targets: the nearest point of the next coarser level.
LodSet simplifiedChain(const std::string& name, const Mesh& mesh, const std::vector<double>& keptShares,
                       ChainNormals normals = ChainNormals::Kept);

/// Unit vertex normals, weighted by the angle of each triangle at the vertex; zero where no triangle has
/// area.
std::vector<glm::vec3> vertexNormals(const Mesh& mesh);

}  // namespace limen::scene
