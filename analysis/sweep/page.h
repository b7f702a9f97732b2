// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/sweep/pictures.h"
#include "analysis/sweep/sweep.h"

namespace limen::analysis {

inline constexpr double kBytesPerMiB = 1024.0 * 1024.0;

/// The charts of a page as inline SVG, by panel; empty text where a panel has nothing to draw.
struct PageCharts {
  std::vector<std::string> speed, counter;
  bool footUsed = false;   ///< a mark stands at an axis' foot
  bool ownRanges = false;  ///< panels do not share their axes
};

/// The whole page, self-contained.
std::string renderPage(const Sweep& sweep, const PageCharts& charts, const Pictures& pictures);

// Its sections, each a piece of HTML or "" if there is nothing to say.
std::string renderNotices(const Sweep& sweep);
std::string renderVerdict(const Sweep& sweep);
std::string renderVisible(const Sweep& sweep);       ///< within the verdict
std::string renderVerdictRules(const Sweep& sweep);  ///< items of a list
std::string renderLegend(const Sweep& sweep);
std::string renderSpeed(const Sweep& sweep, const PageCharts& charts);
std::string renderCounter(const Sweep& sweep, const PageCharts& charts);
std::string renderScalings(const Sweep& sweep);
std::string renderPasses(const Sweep& sweep);
std::string renderPictures(const Sweep& sweep, const Pictures& pictures);
std::string renderRunTable(const Sweep& sweep);
std::string renderRemarks(const Sweep& sweep);
std::string renderProblems(const Sweep& sweep);
std::string renderExpectations(const Sweep& sweep);
std::string renderEnvironment(const Sweep& sweep);

/// "soft_shadows/pcss, samples 8" with the marker of its series, as HTML.
std::string renderCellName(const Sweep& sweep, const Cell& cell);
/// "≈ pcss, samples 8": settings not told apart from one that is named; "" without any.
std::string renderTies(const Sweep& sweep, const std::vector<size_t>& ties);
/// "1.23 ms", with the interval if there is one, as plain text.
std::string describeTime(const Sweep& sweep, const Cell& cell, bool withInterval);
/// "[1.2–1.4]"
std::string bracketed(const MedianInterval& interval);
/// Number with the axis' unit.
std::string withUnit(double value, const Axis& axis);

}  // namespace limen::analysis
