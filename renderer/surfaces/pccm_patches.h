// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/patch_set.h"
#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

/// Four bicubic patches for each quad of a Catmull-Clark control mesh, a C1 spline with one knot in the
/// middle of either direction (PCCM: Peters 2000; Schwarz 2009, section 6.3.2; SC-22). Quads whose vertices
/// are all regular have the surface itself; around an extraordinary vertex patches interpolate its limit
/// point and tangent plane and join with continuous tangent planes; all other edges are C2 but, next to
/// vertices of even valence, C1. The thesis prints no formulas: ours make the edge's first half quadratic and
/// let its neighbours' derivatives across sum to 2 cos(2 pi / n) (1 - t)^2 times that along it. Sharp edges
/// are not looked at. Patches 4 f to 4 f + 3 belong to face f, u < 1/2 and v < 1/2 first, then along u.
/// Neighbours are found. Throws std::invalid_argument if a face is no quad or has two extraordinary vertices,
/// or one lies on a boundary; steps of subdivision separate the former.
PatchSet pccmPatches(const PolygonMesh& mesh);

}  // namespace limen::surfaces
