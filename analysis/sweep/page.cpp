// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/page.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/output/page.h"
#include "analysis/output/text_output.h"
#include "analysis/sweep/chart.h"
#include "analysis/sweep/printed_tables.h"
#include "experiments/base/text.h"

namespace limen::embedded {
extern const char* const kReportCss;
extern const char* const kReportJs;
}  // namespace limen::embedded

namespace limen::analysis {
namespace {

// "3 techniques", "2 values of Budget: rim (px)"
std::string countedGroups(const Sweep& sweep, size_t count, const std::string& by) {
  if (by == "technique" || by == "scene" || by == "image") return counted(count, by);
  return counted(count, "value") + " of " + sweep.names.heading(by);
}

std::string renderHead(const Sweep& sweep) {
  const store::Experiment& experiment = sweep.experiment;
  std::vector<std::string> features;
  for (const nlohmann::json& feature : experiment.features)
    features.push_back(feature.is_string() ? feature.get<std::string>() : feature.dump());
  std::string out = "<header>\n<h1>" + escapeHtml(experiment.title) + "</h1>\n";
  if (!experiment.question.empty())
    out += "<p class=\"question\">" + escapeHtml(experiment.question) + "</p>\n";
  out += "<dl class=\"facts\">";
  const auto fact = [&](const std::string& name, const std::string& value) {
    if (!value.empty()) out += "<div><dt>" + name + "</dt><dd>" + escapeHtml(value) + "</dd></div>";
  };
  std::vector<std::string> devices;
  for (const store::Environment& environment : sweep.environments) indexIn(devices, environment.device);
  fact("Runs", fmt::format("{} of {} done", counted(sweep.cells.size(), "run"), sweep.planned));
  fact("Compared", fmt::format("{} × {}", countedGroups(sweep, sweep.series.size(), sweep.seriesName),
                               countedGroups(sweep, sweep.panels.size(), sweep.panelName)));
  if (!sweep.seriesPrefix.empty()) fact("All techniques are in", sweep.seriesPrefix);
  fact("Measured on", join(devices, "; "));
  fact("Source", experiment.source);
  fact("Features", join(features));
  fact("Descriptor", experiment.path);
  return out + "</dl>\n</header>\n";
}

std::string renderHowToRead(const Sweep& sweep, bool footUsed) {
  const bool byRounds = std::any_of(sweep.cells.begin(), sweep.cells.end(), [](const Cell& cell) {
    return cell.interval && cell.interval->byRounds;
  });
  const bool byFrames = std::any_of(sweep.cells.begin(), sweep.cells.end(), [](const Cell& cell) {
    return cell.interval && !cell.interval->byRounds;
  });
  std::string out = "<section id=\"reading\"><h2>How the numbers were made</h2>\n<ul class=\"prose\">";
  if (sweep.noVerdict.empty())
    out +=
        "<li>A <b>Pareto front</b> is the list of settings that nothing else beats by the medians as they "
        "are: whatever "
        "is faster has a larger error, whatever has a smaller error is slower.</li>" +
        renderVerdictRules(sweep);
  if (byRounds || byFrames)
    out += fmt::format(
        "<li>Times are medians over the frames of a run. Bars and brackets are 95 % percentile bootstrap "
        "intervals of that median (2000 resamples, fixed seed), {}. Two settings whose intervals overlap are "
        "not told apart by this sweep.</li>",
        byRounds && byFrames ? "resampled by whole rounds where a run has three or more, else by frames"
        : byRounds ? "resampled by whole rounds, since frames of one round share the machine's state"
                   : "resampled by frames, since the runs have fewer than three rounds");
  if (footUsed)
    out +=
        "<li>A mark at the tick <b>0</b> (or <b>∞</b>) has exactly that value, which the axis cannot show to "
        "scale.</li>";
  out +=
      "<li>p95 is the 95th percentile of the frame times, by linear interpolation.</li><li>Every number at "
      "full precision: <a href=\"runs.csv\">runs.csv</a>, <a href=\"measurements.csv\">measurements.csv</a>, "
      "<a href=\"frame_times.csv\">frame_times.csv</a>, <a href=\"passes.csv\">passes.csv</a>; what their "
      "names mean: <a href=\"quantities.csv\">quantities.csv</a>, <a "
      "href=\"parameters.csv\">parameters.csv</a>; gnuplot scripts in <a "
      "href=\"charts/\">charts/</a>.</li></ul></section>\n";
  return out;
}

}  // namespace

std::string withUnit(double value, const Axis& axis) {
  return formatNumber(value) + (axis.unit.empty() ? "" : " " + axis.unit);
}

std::string describeTime(const Sweep& sweep, const Cell& cell, bool withInterval) {
  std::string out = withUnit(cell.x.value_or(0.0), sweep.x);
  if (withInterval && cell.interval) out += " " + bracketed(*cell.interval);
  return out;
}

std::string bracketed(const MedianInterval& interval) {
  return "[" + formatNumber(interval.low) + "–" + formatNumber(interval.high) + "]";
}

std::string renderCellName(const Sweep& sweep, const Cell& cell) {
  std::string out = "<span class=\"name\">" + markerSvg(cell.series) + "<b>" +
                    breakable(sweep.series[cell.series]) + "</b>";
  const std::string rest = sweep.seriesName == "technique" ? cell.settings : sweep.label(cell);
  if (!rest.empty()) out += " <span class=\"settings\">" + breakable(rest) + "</span>";
  return out + "</span>";
}

std::string renderTies(const Sweep& sweep, const std::vector<size_t>& ties) {
  constexpr size_t kNamedTies = 2;
  if (ties.empty()) return "";
  std::string text;
  for (const size_t tie : ties)
    text += (text.empty() ? "" : "; ") + escapeHtml(sweep.label(sweep.cells[tie]));
  if (ties.size() > kNamedTies) text = fmt::format("{} others", ties.size());
  return "<span class=\"ties\">≈ " + text + "</span>";
}

std::string renderPage(const Sweep& sweep, const PageCharts& charts, const Pictures& pictures) {
  std::string body = "<main>\n";
  body += renderHead(sweep) + renderNotices(sweep) + renderVerdict(sweep) + renderSpeed(sweep, charts) +
          renderCounter(sweep, charts) + renderScalings(sweep) + renderPrinted(comparePrinted(sweep)) +
          renderPictures(sweep, pictures) + renderPasses(sweep) + renderRunTable(sweep) +
          renderRemarks(sweep) + renderExpectations(sweep) + renderProblems(sweep) +
          renderHowToRead(sweep, charts.footUsed) + renderEnvironment(sweep);
  body += "</main>\n<div id=\"tip\" role=\"status\" aria-live=\"polite\" hidden></div>\n";
  return renderDocument(sweep.experiment.title, embedded::kReportCss, body, embedded::kReportJs);
}

}  // namespace limen::analysis
