// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "perception/multiscale/plane.h"
#include "perception/popping/predictor.h"

namespace limen::perception {

/// Differences of all levels and channels in one map, JND, of the pictures' size.
struct SummedDifferences {
  Plane jnd;          ///< unweighted
  Plane weight;       ///< 0 to 1: disocclusion and flicker
  Plane weightedJnd;  ///< their product
  Plane signedJnd;    ///< weighted; positive where what adds responses outweighs what takes them away
};

/// Minkowski sum. `differences`: of each level, channels A, a, b.
SummedDifferences sumDifferences(const std::vector<std::array<Plane, 3>>& differences,
                                 const PoppingInput& input, const PoppingSettings& settings);

double meanOf(const Plane& plane);

}  // namespace limen::perception
