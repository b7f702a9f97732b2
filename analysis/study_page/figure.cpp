// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study_page/page_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <filesystem>

#include "analysis/output/page.h"
#include "analysis/output/text_output.h"
#include "experiments/base/gnuplot.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

namespace fs = std::filesystem;

constexpr std::array<int, 7> kPoints = {7, 5, 9, 13, 11, 6, 4};
constexpr double kCmPerPx = 8.8 / 460.0;

std::string scriptOf(const Figure& figure) {
  const std::string& name = figure.name;
  std::string out = fmt::format(
      "# Draws {0}.svg and {0}.pdf from {0}.dat: gnuplot {0}.gp\nreset\nset terminal svg name '{0}' size "
      "{1},{2} dynamic font 'system-ui, sans-serif,13' noenhanced\nset output '{0}.svg'\nset encoding "
      "utf8\nset border 3\nset tics nomirror out scale 0.5\nset grid ytics lt 1 lw 0.5 lc rgb '#dddddd'\nset "
      "errorbars 0\nset key below height 1 Left reverse samplen 2.5 maxcols 2\n",
      name, figure.widthPx, figure.heightPx);
  if (!figure.key) out += "set key off\n";
  out += "set xlabel " + gnuplotQuoted(figure.xTitle) + " offset 0,0.5\nset ylabel " +
         gnuplotQuoted(figure.yTitle) + "\n" + figure.settings + "data = '" + name + ".dat'\n";
  for (size_t i = 0; i < figure.plots.size(); ++i)
    out += (i == 0 ? "plot data " : ", \\\n  data ") + figure.plots[i];
  return out + fmt::format(
                   "\nset terminal pdfcairo size {:.1f}cm,{:.1f}cm font 'sans,7' noenhanced\n"
                   "set output '{}.pdf'\nreplot\nset output\n",
                   figure.widthPx * kCmPerPx, figure.heightPx * kCmPerPx, name);
}

}  // namespace

std::string addBlock(Figure& figure, const std::string& meaning,
                     const std::vector<std::vector<double>>& rows) {
  assert(!rows.empty());
  size_t blocks = 0;
  for (size_t at = 0; (at = figure.data.find("# ", at)) != std::string::npos; ++at) ++blocks;
  if (blocks > 0) figure.data += "\n\n";
  std::string words = meaning;
  std::replace_if(
      words.begin(), words.end(), [](char c) { return c == '\n' || c == '\r' || c == '#'; }, ' ');
  figure.data += "# " + words + "\n";
  for (const std::vector<double>& row : rows) {
    for (size_t i = 0; i < row.size(); ++i) {
      assert(std::isfinite(row[i]));
      figure.data += (i > 0 ? " " : "") + shortestNumber(row[i]);
    }
    figure.data += "\n";
  }
  return fmt::format("index {}", blocks);
}

std::string namedTics(const std::string& axis, const std::vector<std::pair<double, std::string>>& labels,
                      bool turned) {
  std::string out;
  for (const auto& [place, label] : labels)
    out += (out.empty() ? "" : ", ") + gnuplotTick(label) + " " + shortestNumber(place);
  return "set " + axis + "tics (" + out + ")" + (turned ? " rotate by 45 right" : "") + "\n";
}

std::string seriesColour(size_t series) {
  return fmt::format("lc rgb '{}'", kChartColours[series % kChartColours.size()]);
}

std::string seriesLook(size_t series) {
  const size_t round = series / kChartColours.size();
  return seriesColour(series) +
         fmt::format(" lw 1.5 dt {} pt {} ps 0.8", round + 1, kPoints[(series + round) % kPoints.size()]);
}

std::map<std::string, std::string> drawFigures(const std::vector<Figure>& figures,
                                               const std::string& folder) {
  std::map<std::string, std::string> out;
  if (figures.empty()) return out;
  std::string all = "# Draws every figure.\n";
  for (const Figure& figure : figures) {
    const fs::path base = fs::path(folder) / figure.name;
    writeFileBytes(base.string() + ".gp", scriptOf(figure));
    writeFileBytes(base.string() + ".dat", figure.data);
    all += "load '" + figure.name + ".gp'\n";
  }
  writeFileBytes((fs::path(folder) / "all.gp").string(), all);
  std::vector<std::string> pictures;
  for (const Figure& figure : figures)
    for (const char* extension : {".svg", ".pdf"}) pictures.push_back(figure.name + extension);
  runGnuplot(folder, "all.gp", pictures);
  for (const Figure& figure : figures)
    out[figure.name] = inlineSvg(readFileBytes((fs::path(folder) / (figure.name + ".svg")).string()),
                                 figure.name, figure.description, "img");
  return out;
}

}  // namespace limen::analysis
