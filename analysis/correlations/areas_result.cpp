// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "analysis/correlations/areas.h"
#include "analysis/correlations/cluster_bootstrap.h"
#include "analysis/output/chart_file.h"
#include "experiments/base/error.h"
#include "experiments/base/gnuplot.h"

namespace limen::analysis {

namespace {

Section sectionOf(const AreaGroup& group, const Areas& all) {
  const std::string level = levelText(all.setting.bootstrap.level);
  const Column drawn = ifAny(interval("bootstrap", level + " bootstrap"));
  Section out;
  out.title = group.name;
  out.fact(key(text("group")), group.name);
  out.fact(integer("rows"), group.rows);
  out.fact(integer("positives", all.outcome + " is 1 in"), group.positives);
  out.fact(
      all.cluster.empty() ? forData(integer("clusters")) : integer("clusters", "different " + all.cluster),
      group.clusters);
  const auto area = [](auto member) { return at(&ColumnArea::area, member); };
  out.add(TableOf("areas", "areas under the ROC curve", group.areas)
              .add(text("x"), &ColumnArea::x)
              .add(number("estimate", "area"), area(&RocArea::area))
              .add(interval("", level), area(&RocArea::interval))
              .add(interval("logit", level + " (logit)"), area(&RocArea::logitInterval))
              .add(drawn, at(&ColumnArea::bootstrap, &ResampledInterval::interval))
              .add(forData(number("variance")), area(&RocArea::variance)));
  const auto compared = [](auto member) { return at(&AreaDifference::comparison, member); };
  out.add(TableOf("differences", "differences of areas", group.differences)
              .add(text("first"), &AreaDifference::first)
              .add(text("second", "minus"), &AreaDifference::second)
              .add(number("estimate", "difference"), compared(&RocComparison::difference))
              .add(interval("", level), compared(&RocComparison::interval))
              .add(number("z"), compared(&RocComparison::z))
              .add(probability(), compared(&RocComparison::p))
              .add(ifAny(probability("p_holm", "p (Holm)")), &AreaDifference::holm)
              .add(drawn, at(&AreaDifference::bootstrap, &ResampledInterval::interval)));
  for (const ColumnCalibration& one : group.calibrations) addCalibration(out, one.calibration, one.x, level);
  for (const ColumnArea& one : group.areas)
    if (one.bootstrap && one.bootstrap->undefined > 0) {
      out.notes.push_back(fmt::format("{} samples of the bootstrap had outcomes of one kind and are left out",
                                      one.bootstrap->undefined));
      break;
    }
  out.notes.insert(out.notes.end(), group.notes.begin(), group.notes.end());
  return out;
}

/// Adds panels to a script and their points to the data.
class AreaChart {
 public:
  explicit AreaChart(const ChartFile& file) : file_(file) {}

  void addCurves(const AreaGroup& group) {
    begin(group.name, "share of 0 at or above (false alarms)", "share of 1 at or above (hits)");
    for (size_t i = 0; i < group.areas.size(); ++i) {
      const ColumnArea& one = group.areas[i];
      for (const RocPoint& point : one.curve)
        data_ += fmt::format("{} {}\n", point.falseAlarmRate, point.hitRate);
      std::string title = fmt::format("{}: area {:.3f}", one.x, one.area.area);
      const auto interval = one.bootstrap ? one.bootstrap->interval : one.area.interval;
      if (interval && interval->low < interval->high)
        title += fmt::format(" ({:.3f} to {:.3f})", interval->low, interval->high);
      add("using 1:2 with lines lw 2 " + seriesStyle(i), title);
    }
    script_ += "\n";
  }

  void addCalibrations(const AreaGroup& group) {
    begin(group.name, "predicted", "share observed");
    for (size_t i = 0; i < group.calibrations.size(); ++i) {
      const ColumnCalibration& one = group.calibrations[i];
      for (const CalibrationBin& bin : one.calibration.bins)
        if (bin.wilson)
          data_ += fmt::format("{} {} {} {}\n", bin.meanPrediction, bin.observed, bin.wilson->low,
                               bin.wilson->high);
      add("using 1:2:3:4 with yerrorlines pt 7 ps 0.8 " + seriesStyle(i),
          fmt::format("{}: Brier {:.4f}", one.x, one.calibration.brier));
    }
    script_ += "\n";
  }

  const std::string& script() const { return script_; }
  const std::string& data() const { return data_; }

 private:
  void begin(const std::string& title, const char* x, const char* y) {
    script_ += "set title " + gnuplotQuoted(title) + " noenhanced\nset xlabel " + gnuplotQuoted(x) +
               "\nset ylabel " + gnuplotQuoted(y) + "\nplot x with lines lc rgb '#BBBBBB' notitle";
  }

  void add(const std::string& how, const std::string& title) {
    data_ += "\n\n";
    script_ +=
        fmt::format(", \\\n  {} index {} {} title {}", file_.data(), block_++, how, gnuplotQuoted(title));
  }

  const ChartFile& file_;
  std::string script_, data_;
  size_t block_ = 0;
};

}  // namespace

Result resultOf(const Areas& areas) {
  Result out;
  out.command = "correlate";
  addBootstrapFacts(out.head, areas.cluster, areas.setting.bootstrap);
  out.head.fact(forData(text("outcome")), areas.outcome);
  for (const AreaGroup& group : areas.groups) out.sections.push_back(sectionOf(group, areas));
  out.notes.push_back(
      "area = P(x of a row with " + areas.outcome +
      " 1 is above x of a row with 0), ties half; intervals and p after DeLong, DeLong and "
      "Clarke-Pearson (1988), which takes rows as independent; (logit): better next to 0 and 1; "
      "p (Holm): adjusted for the pairs of a group");
  if (!areas.cluster.empty()) out.notes.push_back(bootstrapNote(areas.cluster));
  out.notes.push_back(kDashNote);
  return out;
}

void drawAreas(const Areas& areas, const std::string& path) {
  const ChartFile file(path);
  AreaChart chart(file);
  size_t panels = 0;
  for (const AreaGroup& group : areas.groups) {
    if (!group.areas.empty()) chart.addCurves(group), ++panels;
    if (!group.calibrations.empty()) chart.addCalibrations(group), ++panels;
  }
  if (panels == 0) throw Error("there is no area to draw", path, "outcomes are all alike");
  const PanelGrid grid = arrangePanels(panels);
  const double scale = panels == 1 ? 1.0 : 0.85;
  std::string script = file.head(0.8 * scale * static_cast<double>(grid.columns),
                                 1.3 * scale * static_cast<double>(grid.rows)) +
                       "set xrange [0:1]\nset yrange [0:1]\nset size square\n"
                       "set key outside below vertical maxcols 1 Left reverse noenhanced\n";
  if (panels > 1) script += fmt::format("set multiplot layout {},{}\n", grid.rows, grid.columns);
  script += chart.script();
  if (panels > 1) script += "unset multiplot\n";
  file.draw(script, chart.data());
}

}  // namespace limen::analysis
