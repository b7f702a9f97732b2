// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/patch_set.h"
#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

enum class AccNormals {
  Geometry,  ///< of the patches, which meet at an angle near irregular vertices
  /// Cross products of tangent patches of degree 2 x 3 and 3 x 2, as normal fields of degree 5: the same on
  /// both sides of each edge, and on regular faces the surface's.
  TangentPatches
};

/// One bicubic patch for each quad of a Catmull-Clark control mesh: the geometry patches of Loop and Schaefer
/// (2008) (Schwarz 2009, section 6.1.5; SC-23). On faces whose vertices are regular they are the surface
/// itself; elsewhere they interpolate its limit points, and neighbours share their boundaries bit by bit but
/// not their tangents. Boundaries and infinitely sharp edges are the surface's own, and so are the faces
/// along them whose vertices have as many faces on this side as a regular vertex: two, or one at a corner
/// (Kovacs et al. 2009). Semi-sharp edges count as smooth. Neighbours are found. Throws std::invalid_argument
/// if a face is no quad.
PatchSet accPatches(const PolygonMesh& mesh, AccNormals normals = AccNormals::Geometry);

}  // namespace limen::surfaces
