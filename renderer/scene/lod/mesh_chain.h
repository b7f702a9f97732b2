// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/base/enum_names.h"
#include "renderer/scene/lod_set.h"

namespace limen::scene {

/// How the vertices of a coarser level get their normals.
enum class ChainNormals {
  Kept,  ///< the finest level's, as in progressive meshes, which carry attributes along
  Own    ///< recomputed from the level's triangles
};
constexpr EnumNames<ChainNormals, 2> enumNames(ChainNormals) {
  return {{{{ChainNormals::Kept, "kept"}, {ChainNormals::Own, "own"}}}};
}

/// Levels of a triangle mesh by edge collapse, each level from the one before as in a progressive mesh
/// (Schwarz 2009, section 10.3.5): level 0 is the mesh, level i keeps about `keptShares[i - 1]` of its
/// triangles (descending shares; more may remain if the surface's topology forbids further collapses). Levels
/// no smaller than the one before are left out, so there may be fewer than requested.
///
/// deviation: sampledDeviation() from the mesh. statedError: the sum of meshoptimizer's errors of the steps
/// so far: each the square root of a quadric, an estimate of the distance to the planes of the step's
/// triangles. Morph targets: the nearest point of the next coarser level.
LodSet simplifiedChain(const std::string& name, const Mesh& mesh, const std::vector<double>& keptShares,
                       ChainNormals normals = ChainNormals::Kept);

/// Unit vertex normals, weighted by the angle of each triangle at the vertex; zero if no triangle there has
/// area.
std::vector<glm::vec3> vertexNormals(const Mesh& mesh);

}  // namespace limen::scene
