// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/reflections/vertex_reflection/star_surface.h"

namespace limen::reflections {

/// What kind of extremum of the path's length a reflection point is. Convex mirrors have minima only. Concave
/// ones have three zones (Roger 2008, section 2.3.3): near the mirror, one upright picture (minimum); far
/// from it, one upside down (maximum); between them (saddle, or flat), where pictures are many, torn or
/// unstable.
enum class Extremum { Minimum, Maximum, Between };

/// Of |PE| + |PV| at the surface's point in a unit direction, by second differences over steps of `stepShare`
/// of the radius; positions relative to the centre.
Extremum extremumAt(const StarSurface& surface, glm::dvec3 direction, glm::dvec3 eye, glm::dvec3 vertex,
                    double stepShare = 1e-3);

}  // namespace limen::reflections
