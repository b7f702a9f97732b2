// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/surfaces/catmull_clark_point.h"

namespace limen::surfaces {

/// The Loop surface over a face whose three vertices have valence 6 and smooth edges, as a quartic Bézier
/// triangle: 15 control points in the order of patch_set.h, u at the face's first vertex, v at its second.
/// Nothing for other faces. The basis is that of Stam 1998b, "Evaluation of Loop subdivision surfaces".
std::optional<std::array<glm::dvec3, 15>> loopTriangle(const PolygonMesh& mesh, const MeshTopology& topology,
                                                       uint32_t face);

/// A point of the Loop surface at any parameters of one of its faces, u and v the weights of its first and
/// second vertex; as catmullClarkPoint().
LimitPoint loopPoint(const PolygonMesh& mesh, uint32_t face, double u, double v, int mostSteps = 40);

}  // namespace limen::surfaces
