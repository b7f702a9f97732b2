// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "study/presentation/screen_device.h"
#include "study/presentation/swap_timer.h"

namespace limen::study {

/// How well a screen keeps time.
struct TimingReport {
  double nominalHz = 0.0, measuredHz = 0.0;
  int swaps = 0;
  double meanMs = 0.0, sdMs = 0.0, leastMs = 0.0, mostMs = 0.0;  ///< of the intervals
  struct Bin {
    double fromPeriods = 0.0, toPeriods = 0.0;  ///< the last one has no end
    int count = 0;
  };
  std::vector<Bin> histogram;  ///< of the intervals, in periods
  SwapReport classified;
  /// Why it is not fit for a lab, one line each; empty: fit.
  std::vector<std::string> objections;
};
nlohmann::json toJson(const TimingReport& report);
std::string toText(const TimingReport& report);

/// Report over the times at which swaps returned [ns]. Objects to missed frames, to swaps that do not wait,
/// to a rate that is not reported or more than 1 % from the reported one; not to late frames that were shown
/// in time.
TimingReport reportTiming(const std::vector<int64_t>& returnedNs, double nominalHz);

/// Warm-up frames, half a second, which runTiming() shows first and does not count.
int timingWarmUpSwaps(double refreshHz);
/// Flickers between two greys for some seconds after a warm-up.
TimingReport runTiming(ScreenDevice& screen, double seconds);

}  // namespace limen::study
