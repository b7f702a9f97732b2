// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "analysis/sweep/sweep.h"

namespace limen::analysis {

/// The report's chart of error against cost as a Vega-Lite 5 specification with its data: a panel for each
/// scene and setting, intervals, the Pareto front, the rest in tooltips. Opened in the Vega editor it can be
/// changed at will.
std::string vegaLite(const Sweep& sweep);

/// What the chart shows as a LaTeX table (package booktabs), units in its head, settings of the Pareto front
/// bold.
std::string latexTable(const Sweep& sweep);

/// Text as LaTeX shows it literally.
std::string latexText(const std::string& text);

}  // namespace limen::analysis
