// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace limen::analysis {

/// A figure of a study's page: gnuplot draws NAME.svg and NAME.pdf from NAME.gp and NAME.dat, all in one
/// look.
struct Figure {
  std::string name;         ///< of its files; letters, digits and _
  std::string description;  ///< what is to be seen, for who cannot see it
  std::string xTitle, yTitle;
  int widthPx = 460, heightPx = 330;  ///< 460 px are a column of 8.8 cm
  bool key = true;
  std::string settings;            ///< further commands: ranges, tics
  std::string data;                ///< blocks of numbers, parted by two empty lines
  std::vector<std::string> plots;  ///< each what follows the data file in gnuplot's plot command
};

/// Appends a block of rows with a comment that says what it is. Returns "index N", N being its number.
/// A block without rows is refused by an assertion: gnuplot would count the blocks after it wrongly.
std::string addBlock(Figure& figure, const std::string& meaning,
                     const std::vector<std::vector<double>>& rows);

/// "set xtics ('near' 1, 'far' 2)"; turned if the labels are long. `axis`: "x" or "y".
std::string namedTics(const std::string& axis, const std::vector<std::pair<double, std::string>>& labels,
                      bool turned = false);

/// Colour, dash and point of the n-th series, as options of a plot: 49 differ.
std::string seriesLook(size_t series);
/// Colour alone.
std::string seriesColour(size_t series);
/// Thin and grey: what is there to compare with.
inline constexpr const char* kReferenceLook = "lc rgb '#444444' lw 1 dt 2";

/// Draws all into `folder`, in one process. Returns each figure as part of a page, by name. Throws Error as
/// runGnuplot().
std::map<std::string, std::string> drawFigures(const std::vector<Figure>& figures, const std::string& folder);

}  // namespace limen::analysis
