// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/patch_set.h"
#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

/// Four quartic triangles for each quad of a Catmull-Clark control mesh, which meet in its middle: c-patches
/// of 24 control points (Myles, Yeo and Peters 2008; Schwarz 2009, section 6.3.2; SC-24). They interpolate
/// the surface's points and normals at the mesh's vertices; tangent planes agree along all edges and, within
/// a quad, first derivatives. The thesis prints no formulas: ours take edges from limit tangents, tangents
/// across them from accPatches(), and the rest from the middle of its patches.
/// Triangles 4 f to 4 f + 3 belong to face f; side 0 of the k-th runs from vertex k to k + 1, and its corner
/// w = 1 is the middle. Neighbours are found. Throws std::invalid_argument if a face is no quad.
PatchSet cPatches(const PolygonMesh& mesh);

}  // namespace limen::surfaces
