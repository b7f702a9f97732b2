// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

namespace limen {

/// A text as a single-quoted gnuplot string; control characters become blanks.
std::string gnuplotQuoted(const std::string& text);

/// Okabe and Ito's colours, distinguishable with any colour vision; further series differ in their dashes.
inline constexpr std::array<const char*, 7> kChartColours = {"#0072B2", "#D55E00", "#009E73", "#A6408A",
                                                             "#B07C00", "#2E86C1", "#444444"};

/// Terminal and size of a chart in its own file: ".svg", ".png", anything else PDF. `width` and `height` are
/// multiples of the usual size.
std::string gnuplotTerminal(const std::string& extension, double width = 1.0, double height = 1.0);

/// Runs a script in `folder`, which is also its working directory. Throws Error if gnuplot is missing (with
/// the package to install) or fails (with its output).
void runGnuplot(const std::string& folder, const std::string& file);

}  // namespace limen
