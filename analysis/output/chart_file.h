// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace limen::analysis {

/// A chart with the gnuplot script and the data that it is drawn from beside it.
class ChartFile {
 public:
  /// Throws Error unless the name ends in .svg, .pdf or .png.
  explicit ChartFile(const std::string& path);

  /// First lines of a script: output, size in usual widths and heights, plain axes.
  std::string head(double width = 1.0, double height = 1.0) const;
  /// The data file's name as gnuplot's string.
  std::string data() const;
  /// Writes both and draws. Throws Error.
  void draw(const std::string& script, const std::string& data) const;

 private:
  std::string folder_, name_, stem_, extension_;
};

/// Rows and columns of `panels` charts in one picture. Throws Error for more than 24.
struct PanelGrid {
  size_t rows = 1, columns = 1;
};
PanelGrid arrangePanels(size_t panels);

/// Tics at 1, 2 and 5 times powers of ten as gnuplot's command, "" where powers of ten alone will do.
std::string logarithmicTics(double low, double high);

/// "lc rgb '#...' dt 1": told apart by colour first, then by dashes.
std::string seriesStyle(size_t series);

}  // namespace limen::analysis
