// SPDX-License-Identifier: BSD-3-Clause
// Points of Catmull-Clark surfaces as weighted sums of the control mesh, without subdivision (Schwarz 2009,
// section 6.3.1; SC-20).
#pragma once

#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

/// What a smooth inner vertex becomes after so many steps: of its `valence`, its position, and the means of
/// the vertices across its edges and across its quads' diagonals (Kazakov 2007).
glm::dvec3 vertexAfterSteps(int steps, int valence, glm::dvec3 vertex, glm::dvec3 acrossEdges,
                            glm::dvec3 acrossFaces);

/// Evaluates faces at even grids. The weights of the vertices around a face depend on the valences of its
/// corners and on sharp edges and boundaries alone, and are tabulated the first time that these occur (Bolz
/// and Schröder 2002); grids may have any whole number of segments (Schaefer and Warren 2007).
class CatmullClarkMasks {
 public:
  explicit CatmullClarkMasks(int segments) : segments_(segments) {}

  /// (segments + 1)^2 limit points of a quad among quads in rows of constant v. u runs from its vertex 0 to
  /// 1, v from 0 to 3. Sharp edges as in catmullClarkPoint().
  std::vector<glm::dvec3> grid(const PolygonMesh& mesh, const MeshTopology& topology, uint32_t face);

  size_t tables() const { return tables_.size(); }  ///< different surroundings so far

 private:
  using Weights = std::vector<std::vector<double>>;  // by sample, then vertex
  Weights weightsOf(PolygonMesh around) const;

  int segments_;
  std::map<std::vector<double>, Weights> tables_;
};

}  // namespace limen::surfaces
