// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perception/multiscale/plane.h"

namespace limen::perception::cvvdp {

/// Centre frequencies [cycles/deg] of the bands, finest first; the last is the base band's nominal one.
std::vector<double> bandFrequenciesCpd(int width, int height, double pixelsPerDegree);
/// Amplitude of a band's contrasts relative to the difference of its levels.
double bandMultiplier(int band, int bands);

/// Half the size, rounded up. `referenceBorders`: as the authors' program, whose correction at the right
/// border goes by the number of rows and is off by 25 % if one side is odd and the other even.
Plane reduce(const Plane& fine, bool referenceBorders);
/// To twice the size less at most one sample a side.
Plane expand(const Plane& coarse, int width, int height);
/// Gaussian blur of the masking signal; the image is mirrored at its border samples. A plane with a side of 6
/// samples or less is returned as it is.
Plane blurMasker(const Plane& plane);

}  // namespace limen::perception::cvvdp
