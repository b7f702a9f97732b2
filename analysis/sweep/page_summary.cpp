// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"
#include "analysis/sweep/chart.h"
#include "analysis/sweep/page.h"
#include "analysis/sweep/trade_off.h"

namespace limen::analysis {
namespace {

constexpr size_t kOpenFront = 8;  // a longer list is folded, so that the charts stay side by side

bool reaches(const Sweep& sweep, const Cell& cell, double level) {
  return sweep.y.higherIsBetter() ? *cell.y >= level : *cell.y <= level;
}

// Where all panels can be compared: between the tightest and the loosest error on any front.
std::vector<double> errorLevels(const Sweep& sweep) {
  double low = INFINITY, high = -INFINITY;
  for (const Panel& panel : sweep.panels)
    for (const size_t index : panel.front) {
      const double y = *sweep.cells[index].y;
      if (!std::isfinite(y) || (y <= 0.0 && !sweep.y.higherIsBetter())) continue;
      low = std::min(low, y);
      high = std::max(high, y);
    }
  std::vector<double> levels = roundLevels(low, high, !sweep.y.higherIsBetter());
  if (!sweep.y.higherIsBetter()) std::reverse(levels.begin(), levels.end());
  return levels;
}

// The fastest cell of a panel within an error level; null: none reaches it.
const Cell* fastestWithin(const Sweep& sweep, const Panel& panel, double level) {
  for (const size_t index : panel.front)
    if (reaches(sweep, sweep.cells[index], level)) return &sweep.cells[index];
  return nullptr;
}

// Settings within the level whose time this sweep cannot tell from the winner's.
size_t countTies(const Sweep& sweep, const Panel& panel, const Cell& winner, double level) {
  if (!winner.interval) return 0;
  return static_cast<size_t>(std::count_if(panel.cells.begin(), panel.cells.end(), [&](size_t index) {
    const Cell& cell = sweep.cells[index];
    return &cell != &winner && cell.isDrawn() && cell.interval && reaches(sweep, cell, level) &&
           cell.interval->low <= winner.interval->high;
  }));
}

std::string renderWinner(const Sweep& sweep, const Panel& panel, double level) {
  const Cell* winner = fastestWithin(sweep, panel, level);
  const std::string open = fmt::format("<td data-level=\"{} {}\"", sweep.y.higherIsBetter() ? "≥" : "≤",
                                       escapeHtml(withUnit(level, sweep.y)));
  if (winner == nullptr) return open + " class=\"none\">none reaches it</td>";
  std::string out = open + ">" + renderCellName(sweep, *winner) + "<span class=\"value\">" +
                    escapeHtml(describeTime(sweep, *winner, false)) + "</span>";
  if (const size_t ties = countTies(sweep, panel, *winner, level))
    out += fmt::format("<span class=\"ties\">≈ {} more within its interval</span>", ties);
  return out + "</td>";
}

std::string renderMatrix(const Sweep& sweep) {
  const std::vector<double> levels = errorLevels(sweep);
  if (levels.empty()) return "";
  const char* word = sweep.y.higherIsBetter() ? "at least" : "at most";
  std::string out = fmt::format(
      "<div class=\"scroll\"><table class=\"verdict\"><caption>Fastest setting with {} of {} …</caption>\n"
      "<thead><tr><th scope=\"col\">{}</th>",
      escapeHtml(sweep.y.title), word, escapeHtml(sweep.names.heading(sweep.panelName)));
  for (const double level : levels)
    out += fmt::format("<th scope=\"col\">{} {}</th>", sweep.y.higherIsBetter() ? "≥" : "≤",
                       escapeHtml(withUnit(level, sweep.y)));
  out += "</tr></thead>\n<tbody>";
  for (const Panel& panel : sweep.panels) {
    out += "<tr><th scope=\"row\">" + escapeHtml(panel.title) + "</th>";
    for (const double level : levels) out += renderWinner(sweep, panel, level);
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string joinSeries(const Sweep& sweep, const std::vector<size_t>& order,
                       const std::vector<size_t>* counts) {
  std::string out;
  for (const size_t series : order) {
    out += out.empty() ? "" : ", ";
    if (counts != nullptr) out += fmt::format("{} of ", (*counts)[series]);
    out += escapeHtml(sweep.series[series]);
  }
  return out;
}

// "5 of 24 settings are worth their time: 3 of a, 2 of b. Always beaten: c, d."
std::string renderSentence(const Sweep& sweep, const Panel& panel) {
  if (panel.front.empty()) return escapeHtml(panel.title) + ": nothing to compare, no run has both values.";
  std::vector<size_t> onFront(sweep.series.size()), drawn(sweep.series.size());
  for (const size_t index : panel.front) ++onFront[sweep.cells[index].series];
  size_t settings = 0;
  for (const size_t index : panel.cells)
    if (sweep.cells[index].isDrawn()) {
      ++drawn[sweep.cells[index].series];
      ++settings;
    }
  std::vector<size_t> winners, beaten;
  for (size_t series = 0; series < onFront.size(); ++series) {
    if (onFront[series] > 0) winners.push_back(series);
    if (onFront[series] == 0 && drawn[series] > 0) beaten.push_back(series);
  }
  std::stable_sort(winners.begin(), winners.end(),
                   [&](size_t a, size_t b) { return onFront[a] > onFront[b]; });
  std::string out =
      fmt::format("<b>{}</b>: {} of {} settings {} worth {} time: {}.", escapeHtml(panel.title),
                  panel.front.size(), settings, panel.front.size() == 1 ? "is" : "are",
                  panel.front.size() == 1 ? "its" : "their", joinSeries(sweep, winners, &onFront));
  if (!beaten.empty()) out += " Always beaten in both: " + joinSeries(sweep, beaten, nullptr) + ".";
  return out;
}

std::string renderFront(const Sweep& sweep, const Panel& panel) {
  HtmlOptions options;
  options.attributes = " class=\"front\"";
  const auto of = [&](size_t index) -> const Cell& { return sweep.cells[index]; };
  const auto interval = [&](size_t index) {
    return of(index).interval ? "<span class=\"interval\">" + bracketed(*of(index).interval) + "</span>" : "";
  };
  return fmt::format("<details{}><summary>Pareto front: {}, from fast to exact</summary>",
                     panel.front.size() <= kOpenFront ? " open" : "",
                     counted(panel.front.size(), "setting")) +
         toHtml(TableOf("front", "", panel.front)
                    .add(integer("front_number", "#"), [&](size_t index) { return of(index).frontNumber; })
                    .add(html("setting"), [&](size_t index) { return renderCellName(sweep, of(index)); })
                    .add(rounded("x", sweep.x.label()), [&](size_t index) { return of(index).x; })
                    .add(ifAny(html("95 %")), interval)
                    .add(rounded("y", sweep.y.label()), [&](size_t index) { return of(index).y; }),
                options) +
         "</details>\n";
}

}  // namespace

std::string renderNotices(const Sweep& sweep) {
  std::string out;
  const auto notice = [&](const char* kind, const std::string& text) {
    out += fmt::format("<p class=\"notice {}\" role=\"note\">{}</p>\n", kind, text);
  };
  if (!sweep.isComplete())
    notice("bad", fmt::format(
                      "<b>This sweep is not complete.</b> Of {} planned runs {} failed and {} missing. Every "
                      "statement below is about the runs that exist; <a href=\"#problems\">see which are "
                      "not there</a>.",
                      sweep.planned, sweep.failed.size(),
                      sweep.missing.size() == 1 ? "1 is" : fmt::format("{} are", sweep.missing.size())));
  const auto broken = std::count_if(sweep.expectations.begin(), sweep.expectations.end(),
                                    [](const store::Expectation& e) { return !e.held; });
  if (broken > 0)
    notice("bad", fmt::format("<b>{} of {} {} broken.</b> <a href=\"#expectations\">See which.</a>", broken,
                              counted(sweep.expectations.size(), "expectation"), broken == 1 ? "is" : "are"));
  if (sweep.software)
    notice("warn",
           "<b>These times were made by a software renderer on a CPU.</b> They compare techniques on this "
           "CPU only and say nothing about a GPU. Errors and counters do not depend on that.");
  if (!sweep.y.direction)
    notice("warn", "<b>The store does not say whether less or more of “" + escapeHtml(sweep.y.title) +
                       "” is better.</b> Less is taken to be: fronts and verdicts depend on that.");
  else if (sweep.y.direction == Direction::Neither)
    notice("note", "Of “" + escapeHtml(sweep.y.title) +
                       "” neither less nor more is better. Fronts and verdicts here prefer less.");
  if (sweep.severalDevices)
    notice("warn",
           "<b>The runs come from several devices.</b> Each device has its own panels, since times of two "
           "machines cannot be compared.");
  return out;
}

std::string renderVerdict(const Sweep& sweep) {
  std::string out =
      "<section id=\"verdict\"><h2>In short</h2>\n" + renderMatrix(sweep) + "<ul class=\"prose\">";
  for (const Panel& panel : sweep.panels) out += "<li>" + renderSentence(sweep, panel) + "</li>\n";
  out += "</ul>\n";
  size_t undrawn = 0;
  for (const Cell& cell : sweep.cells) undrawn += !cell.isDrawn();
  if (undrawn > 0)
    out += fmt::format("<p>{} {} no value of {} or {} and {} in the table only.</p>", counted(undrawn, "run"),
                       undrawn == 1 ? "has" : "have", escapeHtml(sweep.x.title), escapeHtml(sweep.y.title),
                       undrawn == 1 ? "stands" : "stand");
  return out + "</section>\n";
}

std::string renderLegend(const Sweep& sweep) {
  std::string out = "<ul class=\"legend\" aria-label=\"Series; press to hide or show\">";
  for (size_t series = 0; series < sweep.series.size(); ++series)
    out +=
        fmt::format("<li><button type=\"button\" aria-pressed=\"true\" data-series=\"{}\">{}{}</button></li>",
                    series, markerSvg(series), escapeHtml(sweep.series[series]));
  return out + "</ul>\n";
}

std::string renderSpeed(const Sweep& sweep, const PageCharts& charts) {
  std::string out = fmt::format(
      "<section id=\"speed\"><h2>Speed against error</h2>\n<p>Left is faster, down is more exact. The grey "
      "step is the Pareto front; its settings are numbered and listed below each chart. {}Point at a mark "
      "for its values; press a name to hide or show it in all charts.</p>\n",
      sweep.x.pass.empty() ? "" : "Bars are 95 % intervals of the median time. ");
  out += renderLegend(sweep) + "<div class=\"panels\">\n";
  for (size_t index = 0; index < sweep.panels.size(); ++index) {
    const Panel& panel = sweep.panels[index];
    out += "<article class=\"panel\"><h3>" + escapeHtml(panel.title) + "</h3>\n";
    out += charts.speed[index].empty() ? "<p>No run of this panel has both values.</p>"
                                       : charts.speed[index] + renderFront(sweep, panel);
    out += "</article>\n";
  }
  return out + "</div></section>\n";
}

std::string renderCounter(const Sweep& sweep, const PageCharts& charts) {
  if (!sweep.counter) return "";
  std::string out = fmt::format(
      "<section id=\"counter\"><h2>Error against {}</h2>\n<p>A cost that does not depend on the machine. "
      "Only runs that count it are drawn; the grey step is the front among them.</p>\n",
      escapeHtml(sweep.counter->label()));
  out += renderLegend(sweep) + "<div class=\"panels\">\n";
  for (size_t index = 0; index < sweep.panels.size(); ++index) {
    if (charts.counter[index].empty()) continue;
    out += "<article class=\"panel\"><h3>" + escapeHtml(sweep.panels[index].title) + "</h3>\n" +
           charts.counter[index] + "</article>\n";
  }
  return out + "</div></section>\n";
}

}  // namespace limen::analysis
