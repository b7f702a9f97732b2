// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/output/chart_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "experiments/base/error.h"
#include "experiments/base/gnuplot.h"
#include "experiments/base/printable.h"

namespace limen::analysis {

ChartFile::ChartFile(const std::string& path) {
  const std::filesystem::path file(path);
  extension_ = file.extension().string();
  if (extension_ != ".svg" && extension_ != ".pdf" && extension_ != ".png")
    throw Error("no picture of the kind '" + extension_ + "' is drawn", path,
                "let the name end in .svg, .pdf or .png");
  requirePlainName(path, "--plot");
  folder_ = file.parent_path().empty() ? "." : file.parent_path().string();
  name_ = file.filename().string();
  stem_ = file.stem().string();
}

std::string ChartFile::head(double width, double height) const {
  const auto output = [&](const std::string& extension) {
    return "set terminal " + gnuplotTerminal(extension, width, height) + "\nset output " +
           gnuplotFile(stem_ + extension) + "\n";
  };
  return "# Draws " + name_ + " from " + stem_ + ".dat. For a paper: gnuplot -e pdf=1 " + stem_ +
         ".gp\nreset\nif (exists('pdf')) {\n" + output(".pdf") + "} else {\n" + output(extension_) +
         "}\nset encoding utf8\nset border 3\nset tics nomirror out\n";
}

std::string ChartFile::data() const { return gnuplotFile(stem_ + ".dat"); }

void ChartFile::draw(const std::string& script, const std::string& data) const {
  drawPicture((std::filesystem::path(folder_) / name_).string(), script, data);
}

PanelGrid arrangePanels(size_t panels) {
  constexpr size_t kMost = 24;
  if (panels > kMost)
    throw Error(fmt::format("{} panels are more than fit into a picture ({})", panels, kMost), "--plot",
                "name fewer columns or groups");
  PanelGrid out;
  out.columns = std::max<size_t>(1, static_cast<size_t>(std::ceil(std::sqrt(static_cast<double>(panels)))));
  out.rows = std::max<size_t>(1, (panels + out.columns - 1) / out.columns);
  return out;
}

std::string logarithmicTics(double low, double high) {
  if (high / low > 1000.0) return {};
  std::string list;
  for (double power = std::pow(10.0, std::floor(std::log10(low))); power <= high; power *= 10.0)
    for (const double step : {1.0, 2.0, 5.0})
      if (step * power >= low && step * power <= high)
        list += fmt::format("{}{:.6g}", list.empty() ? "" : ", ", step * power);
  return list.empty() ? std::string() : "set xtics (" + list + ")\n";
}

std::string seriesStyle(size_t series) {
  return fmt::format("lc rgb '{}' dt {}", kChartColours[series % kChartColours.size()],
                     1 + series / kChartColours.size());
}

}  // namespace limen::analysis
