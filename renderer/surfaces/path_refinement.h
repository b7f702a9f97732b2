// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/recursion.h"

namespace limen::surfaces {

/// Path-based adaptation (Velho and de Figueiredo 1996; Schwarz 2009, section 7.2.5; SC-46): curves over the
/// sides of a triangulation of the domain are sampled until they are flat, then a triangle is split at the
/// middle sample of its side that has most, which makes a new curve to be sampled. Neighbours share samples:
/// there are no cracks and no T-vertices within a patch, nor between patches that share their boundary. What
/// no curve passes is missed. Flatness is the distance of three points
/// from the chord on the screen.
TessellatedSurface refinedAlongPaths(const PatchSet& set, const SurfaceView& view,
                                     const RecursionSettings& settings, glm::dvec3 anchor,
                                     RecursionCounts& counts);

}  // namespace limen::surfaces
