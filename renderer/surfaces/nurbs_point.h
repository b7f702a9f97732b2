// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/nurbs.h"

namespace limen::surfaces {

/// The surface at parameters in the knots' own units, homogeneous, without patches: the span of each
/// direction is found by bisection, then de Boor's algorithm (Schwarz 2009, section 6.1.4; SC-16). Parameters
/// outside the surface are clamped; the last knot belongs to the last span.
glm::dvec4 nurbsPoint(const NurbsSurface& surface, double u, double v);

/// The same at all pairs of the given parameters, v by v: what depends on one parameter alone is computed
/// once (Krishnamurthy et al. 2007; SC-17). The bits are those of nurbsPoint().
std::vector<glm::dvec4> nurbsGrid(const NurbsSurface& surface, const std::vector<double>& u,
                                  const std::vector<double>& v);

}  // namespace limen::surfaces
