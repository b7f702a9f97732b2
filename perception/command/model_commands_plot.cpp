// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <filesystem>

#include "experiments/base/error.h"
#include "experiments/base/gnuplot.h"
#include "experiments/base/printable.h"
#include "experiments/base/text.h"
#include "perception/command/model_commands.h"

namespace limen::perception {
namespace {

namespace fs = std::filesystem;

std::string script(const Plot& plot, const fs::path& file) {
  const std::string stem = file.stem().string();
  std::string out = "# Draws " + file.filename().string() + " from " + stem + ".dat.\nreset\nset terminal " +
                    gnuplotTerminal(file.extension().string()) + "\nset output " +
                    gnuplotFile(file.filename().string()) +
                    "\nset encoding utf8\nset border 3\nset tics nomirror out\nset logscale xy\n"
                    "set grid xtics ytics lt 1 lw 0.5 lc rgb '#dddddd'\n";
  out += plot.curves.size() > 1 ? "set key outside right top Left reverse noenhanced samplen 2\n"
                                : "set key off\n";
  out += "set title " + gnuplotQuoted(plot.title) + " noenhanced\nset xlabel " + gnuplotQuoted(plot.xTitle) +
         " noenhanced\nset ylabel " + gnuplotQuoted(plot.yTitle) + " noenhanced\nset format xy '%g'\n";
  std::string curves;
  for (size_t i = 0; i < plot.curves.size(); ++i)
    curves += fmt::format(
        "{0}{1} index {2} using 1:2 with lines lw 2.5 dt {3} lc rgb '{4}' title {5}"
        ", \\\n  '' index {2} using 1:3 with lines lw 1 dt {3} lc rgb '{4}' notitle",
        i == 0 ? "" : ", \\\n  ", i == 0 ? gnuplotFile(stem + ".dat") : "''", i, 1 + i / kChartColours.size(),
        kChartColours[i % kChartColours.size()], gnuplotQuoted(plot.curves[i].name));
  return out + "plot " + curves + "\n";
}

std::string data(const Plot& plot) {
  std::string out;
  for (const Plot::Curve& curve : plot.curves) {
    std::string name = curve.name;
    for (char& c : name)
      if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    out += (out.empty() ? "# " : "\n\n# ") + name + ": x, value, value outside the model's range\n";
    bool any = false;
    for (size_t i = 0; i < curve.points.size(); ++i) {
      const auto& [x, y, outside] = curve.points[i];
      if (!(x > 0.0) || !(y > 0.0)) continue;
      // The thin line continues to the first point inside, so that the two meet.
      const bool beside = (i > 0 && curve.points[i - 1].outside) ||
                          (i + 1 < curve.points.size() && curve.points[i + 1].outside);
      const std::string value = shortestNumber(y);
      out += shortestNumber(x) + " " + (outside ? "NaN" : value) + " " + (outside || beside ? value : "NaN") +
             "\n";
      any = true;
    }
    // An empty data set would shift the indices of those after it.
    if (!any) out += "NaN NaN NaN\n";
  }
  return out;
}

}  // namespace

void drawPlot(const Plot& plot, const std::string& file) {
  const fs::path path(file);
  const std::string extension = path.extension().string();
  if (extension != ".svg" && extension != ".png" && extension != ".pdf")
    throw Error("'" + file + "' is neither SVG, PNG nor PDF", "--plot",
                "let the name end in .svg, .png or .pdf");
  requirePlainName(file, "--plot");
  drawPicture(file, script(plot, path), data(plot));
}

}  // namespace limen::perception
