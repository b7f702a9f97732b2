// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/patch_set.h"
#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

/// One bicubic patch for each quad of a Catmull-Clark control mesh: the geometry patches of Loop and Schaefer
/// (2008) (Schwarz 2009, section 6.1.5; SC-23). On faces whose vertices are regular they are the surface
/// itself; elsewhere they interpolate its limit points, and neighbours share their boundaries bit by bit but
/// not their tangents. Boundaries are the surface's own. Sharp edges are not looked at. Neighbours are found.
/// Throws std::invalid_argument if a face is no quad.
PatchSet accPatches(const PolygonMesh& mesh);

}  // namespace limen::surfaces
