// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

namespace limen {

/// A text as an expression of gnuplot's that is this text, whatever it holds; control characters become
/// blanks. All text in scripts goes through this or the two below.
std::string gnuplotQuoted(const std::string& text);
/// The same as the label of a tick, in which gnuplot looks for formats of numbers.
std::string gnuplotTick(const std::string& label);
/// The name of a file in the script's folder, for reading or writing: gnuplot takes names that begin with <
/// or | as commands. Throws Error as requirePlainName().
std::string gnuplotFile(const std::string& name);

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
