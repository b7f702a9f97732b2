// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/output/result.h"
#include "analysis/sweep/crossing.h"
#include "experiments/store/store.h"

namespace limen::analysis {

struct SwitchOptions {
  std::string storePath;
  std::string experiment;    ///< as in chooseExperiments()
  std::string folder;        ///< for chart and CSV; "": none are written
  double probability = 0.5;  ///< of detection that a switch may have
  double confidence = 0.95;
  std::string measurement = "detection_probability";
  std::string distance = "distance";                 ///< parameter that is the distance
  std::vector<std::string> views = {"azimuth_deg"};  ///< parameters that make replicates, not conditions
  uint64_t seed = 1;
  bool force = false;  ///< go on although runs are missing or failed
};

/// One switch under one condition: how the probability of detection falls with distance and where it comes
/// down to what is allowed.
struct SwitchDistance {
  std::string technique, scene;
  std::map<std::string, std::string> condition;  ///< what varies between switches: levels, speed, display ...
  std::vector<double> distances;                 ///< ascending
  std::vector<std::vector<double>> views;        ///< probability by view and distance
  CrossingEstimate estimate;
};

struct SwitchReport {
  std::string title, hash;
  double probability = 0.5, confidence = 0.95;
  std::vector<SwitchDistance> switches;
  size_t leftOut = 0;  ///< runs missing or failed, with `force`
  /// Without which the distances say nothing, where it is the same for all: "display", "height", "width" ...
  std::map<std::string, std::string> seen = {};
  std::string distanceLabel = "Distance", probabilityLabel = "Probability of detection";  ///< of the axes
};

/// Distances at which each level-of-detail switch of a sweep may happen. The sweep varies the distance, and
/// for an interval the view. Throws Error: the measurement or the distance is missing, a view lacks a
/// distance that others have, the sweep is not complete (without `force`).
std::vector<SwitchReport> findSwitchDistances(const SwitchOptions& options);

/// Tables "switches" and "curves".
Result resultOf(const SwitchReport& report);
/// Draws into FILE.svg, .pdf or .png, with the gnuplot script and data beside it, and returns the path.
/// Throws Error.
std::string drawSwitchChart(const SwitchReport& report, const std::string& path);

}  // namespace limen::analysis
