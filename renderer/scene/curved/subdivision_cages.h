// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/subdivision_surface.h"

namespace limen::scene {

/// Two pyramids, tip up and tip down: two vertices of the valence, numbers 0 and 1, all others of valence 4;
/// somewhat uneven.
surfaces::PolygonMesh pyramids(uint32_t valence);
surfaces::PolygonMesh tetrahedron();
/// Open, standing; triangles, or quads.
surfaces::PolygonMesh bumpySheet(uint32_t side, bool quads);
/// Triangles around a vertex of the boundary, which is number 0.
surfaces::PolygonMesh openFan(uint32_t faces);
/// A ring, standing, with texture coordinates from 0 to 1 around it and along it, which end at two seams that
/// cross, and its height as the third attribute, which has no seam of its own. Quads, or triangles.
surfaces::SubdivisionSurface seamedRing(bool quads);

}  // namespace limen::scene
