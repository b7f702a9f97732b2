// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/patch_set.h"
#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

/// A fan of quartic triangles for each face of three, four or five sides, which meet in its middle:
/// P_m-patches of 6 m + 1 control points (Myles, Ni and Peters 2008; Schwarz 2009, section 6.3.2; SC-24).
/// Tangent planes agree along all edges, and within a face first derivatives, as if the triangles filled a
/// regular polygon; where all faces around a vertex are quads, its point and normal are those of
/// Catmull-Clark's surface. The thesis prints no formulas: ours are those of cPatches() with middles of faces
/// in place of opposite vertices, and the inside follows second differences of the rows before. Neither
/// sharpness nor polar vertices are looked at. Triangles are in the order of faces and their sides; side 0 of
/// the k-th of a face runs from its vertex k to k + 1, and its corner w = 1 is the middle. Neighbours are
/// found. Throws std::invalid_argument if the mesh is open or a face has more than five sides.
PatchSet pmPatches(const PolygonMesh& mesh);

}  // namespace limen::surfaces
