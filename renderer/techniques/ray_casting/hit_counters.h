// SPDX-License-Identifier: BSD-3-Clause
// What a picture of a surface alone shows in place of what its pixels see: counters that its techniques
// share.
#pragma once

#include "renderer/techniques/ray_casting/view_rays.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// `own`, followed by those of hitCounters().
std::vector<Quantity> withHitQuantities(std::vector<Quantity> own);
std::vector<Counter> hitCounters(const HitErrors& errors);
/// Compared with interval arithmetic, which misses no root. `seen`: distances along the view are in the
/// fourth channel, 0: no hit.
std::vector<Counter> hitCounters(frame::Frame& frame, const Image& seen);
std::vector<double> seenDistances(const Image& seen);

}  // namespace limen::techniques
