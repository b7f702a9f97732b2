// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "renderer/techniques/scene_needs/candidate.h"
#include "renderer/techniques/scene_needs/error_estimate.h"

namespace limen::techniques {

/// Time of whole frames [ms]; its spread is from the lower to the upper quartile.
struct TimeEstimate {
  double medianMs = 0.0, lowMs = 0.0, highMs = 0.0;
  int frames = 0;
};
/// Of at least one frame.
TimeEstimate estimateTime(std::vector<double> framesMs);

/// A candidate with what was measured of it.
struct Tried {
  Candidate candidate;
  ErrorEstimate error;
  TimeEstimate time;
};

struct Verdict {
  size_t chosen = 0;
  bool withinTarget = false;  ///< otherwise it is the most exact
  /// Among which it was chosen: all candidates within the target, or those that are as exact as the most
  /// exact one, up to the references' noise.
  std::vector<size_t> eligible;
};

/// By what share the error of a picture with many more pixels may exceed the estimate: the median over the
/// candidates of high() / value() - 1. One figure for all of them, so that less error is never further
/// from a target.
double margin(std::span<const Tried> tried);
bool isWithin(const ErrorEstimate& error, double target, double margin);
/// See Verdict. Needs errors, not times.
std::vector<size_t> eligible(std::span<const Tried> tried, double target);
/// Of the eligible candidates the cheapest; of several whose times spread into its own, the one with the
/// smallest error; of several whose errors differ by less than the references' noise, the cheapest again. No
/// other eligible candidate takes less time and errs less. `tried` must not be empty.
Verdict decide(std::span<const Tried> tried, double target);
/// Those than which no other takes less time and errs less, fastest first.
std::vector<size_t> front(std::span<const Tried> tried);

}  // namespace limen::techniques
