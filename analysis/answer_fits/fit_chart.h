// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/answer_fits/fit_answer.h"

namespace limen::analysis {

/// Answers to one level. `blank`: without a stimulus, set at the edge of the picture that F is 0 towards.
struct FitPoint {
  double level = 0.0, share = 0.0;  ///< share of correct or positive answers, 0 to 1
  int64_t trials = 0;
  bool blank = false;
};

/// What is drawn of one condition.
struct FitSeries {
  std::string name;
  std::vector<FitPoint> points;
  std::vector<std::array<double, 2>> curve;  ///< level and fitted share, from edge to edge
  double threshold = 0.0, thresholdShare = 0.0;
  FitInterval interval;  ///< of the threshold; of no width if there is none
};

/// What a picture of fitted functions shows, whatever draws it.
struct FitChart {
  double low = 0.0, high = 0.0;  ///< levels at its edges, a little beyond answers and thresholds
  bool logarithmic = false, falling = false;
  bool blanks = false;  ///< some points are blank
  std::string xTics;    ///< gnuplot's command for them; "": its own will do
  std::vector<FitSeries> series;
};

FitChart chartOf(const FitAnswer& answer);
/// Of a point by its trials in column 3, as gnuplot's expression: its area grows with them.
std::string pointSize(const FitChart& chart);

}  // namespace limen::analysis
