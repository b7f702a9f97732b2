// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/corner_normals.h"

namespace limen::surfaces {

/// Scalar tags of PN triangles (Boubekeur et al. 2005; Schwarz 2009, section 6.1.3; SC-11), here the same at
/// all vertices. The thesis prints no formulas; these are ours, after continuity, tension and bias of
/// splines. The third tag, tension, is that of PnSettings.
struct ScalarTags {
  double sharpness = 1.0;  ///< 0: smooth; 1: creases with all of the discontinuity
  double bias =
      0.0;  ///< -1 to 1: 0: both sides of a crease turn alike; at 1 the first alone, at -1 the other
};

/// Sets the corner normals of a mesh with merged positions. At a vertex let N be its mean normal (of all
/// triangles) and N_a, N_b those on both sides of a crease of at least `creaseDeg` degrees; the discontinuity
/// is their difference D. Corners get the direction of N + sharpness ((N_side - N) + bias D / 2). With other
/// than two sides there is no bias. Untagged vertices, without a crease, have the mean normal.
void tagCornerNormals(BaseMesh& mesh, double creaseDeg, const ScalarTags& tags);

}  // namespace limen::surfaces
