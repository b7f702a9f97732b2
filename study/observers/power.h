// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/observers/observer.h"

namespace limen::study {

struct PowerRequest {
  std::vector<int> observers = {5, 10, 20, 40}, repetitions = {1, 2, 3, 5};
  double confidence = 0.95;
  /// Target width of the intervals (upper minus lower end) of rates, and of thresholds in their own units;
  /// without the latter thresholds are reported but not evaluated.
  double width = 0.2;
  std::optional<double> thresholdWidth;
  double probability = 0.8;  ///< probability with which a condition's interval has to be that narrow
  int simulations = 200;
  uint64_t seed = 1;
};

/// One condition of one design. "Rate" is the share of change trials with "yes", of correct answers, of
/// ratings above the lowest, of choices of the second item.
struct PowerCell {
  std::string part;
  std::map<std::string, std::string> condition;
  bool threshold = false;  ///< false: rate
  std::string unit;
  double mean = 0.0;            ///< of the estimates over all simulated observers
  double sdBetween = 0.0;       ///< root of the mean sample variance of the observers' values
  double meanWidth = 0.0;       ///< expected width; infinite if a threshold's estimate was missing
  double meanWidthError = 0.0;  ///< Monte Carlo standard error
  double reached = 0.0;         ///< share of experiments with a width up to the target
  double reachedError = 0.0;    ///< Monte Carlo standard error, binomial
  double degenerate = 0.0;      ///< share in which all observers agreed
};

struct PowerDesign {
  int observers = 0, repetitions = 0;
  std::vector<PowerCell> cells;
  bool judged = false;   ///< some cell has a target width
  size_t worst = 0;      ///< the cell that reaches it least often
  bool reaches = false;  ///< the worst cell does with the target probability
  bool clear = false;    ///< and that probability is two standard errors off the target
};

struct PowerResult {
  std::vector<PowerDesign> designs;  ///< by repetitions, then observers
  std::optional<size_t> fewestObservers, fewestTrials;
};

/// Expected widths of Student's t intervals over observers of each condition's mean rate (and of the mean of
/// adaptive procedures' threshold estimates), by simulation: per experiment `observers` observers are drawn
/// and answer the protocol's trials with `repetitions` in place of its own (a procedure is run that often and
/// its estimates averaged; with constant stimuli each stimulus counts as a condition). Designs share their
/// observers and seeds, so that their differences are less noisy than their values. Catch trials and practice
/// are left out. If all n observers agree, the t interval would have zero width and say nothing about the
/// spread: for rates the exact binomial interval of n answers is used instead (Clopper and Pearson 1934,
/// Biometrika 26), for thresholds the width is infinite. `progress`: called with the share done; returns true
/// to stop (the result then has no designs).
PowerResult simulatePower(const Protocol& protocol, const ObserverBehaviour& behaviour,
                          const PowerRequest& request, StimulusModel* model = nullptr,
                          const std::function<bool(double)>& progress = {});

}  // namespace limen::study
