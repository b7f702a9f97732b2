// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

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
                                                             "#B07C00", "#7F4F24", "#444444"};

/// Terminal and size of a chart in its own file: ".svg", ".png", anything else PDF. `width` and `height` are
/// multiples of the usual size.
std::string gnuplotTerminal(const std::string& extension, double width = 1.0, double height = 1.0);

/// Runs a script that lies in `folder`, with that as its working folder, and checks that the `pictures` that
/// it makes there are whole. Throws Error: gnuplot is missing (with the package to install) or fails (with
/// what it said).
void runGnuplot(const std::string& folder, const std::string& file, const std::vector<std::string>& pictures);

/// Draws into `picture`, which ends in .svg, .pdf or .png; script and data come to lie beside it as STEM.gp
/// and STEM.dat. The script writes to the picture's bare name and reads that of the data. All three are put
/// in place once the picture is whole. Throws Error as runGnuplot(), and if one of the three is an input of
/// this call.
void drawPicture(const std::string& picture, const std::string& script, const std::string& data);

}  // namespace limen
