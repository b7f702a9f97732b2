// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/subdivision_surface.h"

namespace limen::scene {

/// A standing figure with arms spread, 1,450 vertices and 1,448 quads, closed: as many as the "Big Guy" of
/// Holländer 2013, Table 2.1, whose data are not free. Faces +z, feet at y = 0, 1 high. Its joints swing
/// arms, legs and head.
surfaces::SubdivisionSurface figureOfQuads();
/// The same in 2,896 triangles, valences 3 to 7.
surfaces::SubdivisionSurface figureOfTriangles();

}  // namespace limen::scene
