// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/sweep/sweep.h"

namespace limen::analysis {

/// Differences in this unit are just noticeable at 1.
inline constexpr const char* kVisibleUnit = "JND";
inline constexpr double kVisibleFrom = 1.0;

/// Of one panel, by one measure of visible difference. Indices are those of Sweep::cells.
struct VisibleChoice {
  std::optional<size_t> cheapest;  ///< of those below kVisibleFrom; empty: there is none
  std::vector<size_t> ties;        ///< below it too, at a time not told apart; in order of time
  std::optional<size_t> least;     ///< with the smallest difference; empty: nothing was measured
};

/// What a sweep says of visible differences.
struct VisibleVerdict {
  struct Measure {
    Axis axis;
    std::vector<VisibleChoice> panels;
  };
  std::vector<Measure> measures;  ///< errors in kVisibleUnit, as declared
  Axis cost;                      ///< the x axis if that is a cost, else the frame's time
  std::string displays;           ///< on which they were predicted: "desktop_24 from 0.6 m"
};
/// Without measures if the sweep has none.
VisibleVerdict findVisible(const Sweep& sweep);

/// What a run costs by `visible.cost`.
std::optional<double> visibleCost(const Sweep& sweep, const VisibleVerdict& visible, const Cell& cell);

}  // namespace limen::analysis
