// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "analysis/output/result.h"

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

/// A file beside the page.
struct PageFile {
  std::string path;  ///< from the page's folder
  std::string bytes, meaning;
};

/// What the sections of a page write into. Figures and tables are numbered as they come; figures are drawn
/// together when the page is finished.
class PageWriter {
 public:
  void openSection(const std::string& id, const std::string& title);
  void closeSection();
  void heading(const std::string& text);  ///< within a section
  void paragraph(const std::string& text);
  void notice(const std::string& text, bool bad = false);
  void list(const std::vector<std::string>& items);
  /// What people see of a table; its first column heads each row. `file`: CSV with the same at full
  /// precision, "" if there is none. Nothing for a table without rows. Folded from `openRows` rows on.
  void table(const ResultTable& table, const std::string& caption, const std::string& file = {},
             size_t openRows = 40);
  void figure(Figure figure, const std::string& caption);
  void html(const std::string& text) { html_ += text; }  ///< as it is
  void file(const std::string& path, const std::string& bytes, const std::string& meaning);

  const std::vector<Figure>& figures() const { return figures_; }
  const std::vector<PageFile>& files() const { return files_; }

  /// The page's body with figures put in: `drawn` by their names.
  std::string body(const std::map<std::string, std::string>& drawn) const;

 private:
  std::string html_;
  std::vector<Figure> figures_;
  std::vector<PageFile> files_;
  size_t tables_ = 0;
};

}  // namespace limen::analysis
