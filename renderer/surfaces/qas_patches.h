// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/patch_set.h"
#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

/// Quadratic approximation of a Loop surface (Boubekeur and Schlick 2007; Schwarz 2009, section 6.1.5;
/// SC-25): for each triangle of the mesh, a quadratic triangle for the position and one for the normals,
/// through the limits of the vertices and of the edges' middles after one step of subdivision. Neighbours
/// share their boundaries bit by bit and are found. Sharp edges and boundaries are the surface's own at those
/// points; semi-sharp ones throw std::invalid_argument.
PatchSet qasPatches(const PolygonMesh& mesh);

}  // namespace limen::surfaces
