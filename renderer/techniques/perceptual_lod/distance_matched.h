// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "renderer/scene/lod_control.h"

namespace limen::techniques {

/// Factors of the switch distances, ascending: 0, and all at which control by distance changes a level.
/// Larger factors are finer.
std::vector<double> matchingFactors(const scene::Scene& scene, const scene::LodView& view);

/// Smallest factor of the switch distances with which control by distance draws at least `triangles`
/// (background included); if none does, the factor that makes all objects finest.
double factorForTriangles(const scene::Scene& scene, const scene::LodView& view, uint64_t triangles);

/// Result of factorForTime().
struct TimedFactor {
  double factor = 0.0, frameMs = 0.0;
};
/// Largest of ascending `factors` (at least one) whose frame takes at most `limitMs`, or the first if none
/// does. `frameMs` measures; it is asked for about log2(n) factors, and taken to grow with them but for its
/// noise.
TimedFactor factorForTime(const std::vector<double>& factors, double limitMs,
                          const std::function<double(double factor)>& frameMs);

}  // namespace limen::techniques
