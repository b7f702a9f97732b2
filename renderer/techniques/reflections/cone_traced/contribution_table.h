// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace limen::techniques {

/// Weight of directions in a glossy mirror's cone, as a function of their distance from its axis, 0 to 1 in
/// units of the cone's angle: the lobe, the same from all directions of a cone, seen from all of the pixel's
/// own reflection. `wide`: share of the cone's angle that is the pixel's reflection, 0 to 1, the rest the
/// lobe's. Of any unit.
double coneWeight(double distance, double wide);

/// Contribution of what fills `share` of a cone around a point at `distance` from its axis (Roger 2008,
/// section 5.2.3, F): the overlap is replaced by a disk of the same area there, and the share is multiplied
/// by the mean of coneWeight() over that disk within the cone, relative to the whole cone's. 1 for the whole
/// cone.
double coneContribution(double share, double distance, double wide);

/// coneContribution() at side x side places, share along rows, distance along columns, both from 0 to 1.
std::vector<float> contributionTable(int side, double wide);

}  // namespace limen::techniques
