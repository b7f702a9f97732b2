// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"
#include "analysis/sweep/chart.h"
#include "analysis/sweep/page.h"

namespace limen::analysis {
namespace {

constexpr size_t kOpenFront = 8;  // a longer list is folded, so that the charts stay side by side

std::string renderFront(const Sweep& sweep, const Panel& panel) {
  if (panel.front.empty()) return "";
  HtmlOptions options;
  options.attributes = " class=\"front\"";
  options.ofRow = [&](size_t row) {
    return fmt::format(" data-series=\"{}\"", sweep.cells[panel.front[row]].series);
  };
  const auto of = [&](size_t index) -> const Cell& { return sweep.cells[index]; };
  const auto interval = [&](size_t index) {
    return of(index).interval ? "<span class=\"interval\">" + bracketed(*of(index).interval) + "</span>" : "";
  };
  const double least = sweep.comparableError(of(panel.front.back()));
  const auto note = [&](size_t index) {
    return panel.verdict.knee == index ? "knee" : of(index).worth ? "yes" : "no";
  };
  return fmt::format("<details{}><summary>Pareto front: {}, from fast to exact</summary>",
                     panel.front.size() <= kOpenFront ? " open" : "",
                     counted(panel.front.size(), "setting")) +
         toHtml(TableOf("front", "", panel.front)
                    .add(integer("front_number", "#"), [&](size_t index) { return of(index).frontNumber; })
                    .add(html("setting"), [&](size_t index) { return renderCellName(sweep, of(index)); })
                    .add(rounded("x", sweep.x.label()), [&](size_t index) { return of(index).x; })
                    .add(ifAny(html("95 %")), interval)
                    .add(rounded("y", sweep.y.label()), [&](size_t index) { return of(index).y; })
                    .addIf(least > 0.0, significant("times_least", "× the least", 3),
                           [&](size_t index) { return sweep.comparableError(of(index)) / least; })
                    .add(text("verdict", "Worth it"), note),
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
  if (sweep.severalDevices)
    notice("warn",
           "<b>The runs come from several devices.</b> Each device has its own panels with a verdict of its "
           "own, since times of two machines cannot be compared.");
  return out;
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
  const bool verdict = sweep.noVerdict.empty();
  std::string out = fmt::format(
      "<section id=\"speed\"><h2>{}</h2>\n<p>{}{}{}Point at a mark for its values; press a name to hide or "
      "show it in all charts.</p>\n",
      verdict ? sweep.xIsTime ? "Speed against error" : "Cost against error"
              : escapeHtml(sweep.y.title + " against " + sweep.x.title),
      verdict
          ? fmt::format("Left is {}, down is more exact. The grey step is the Pareto front of what is shown; "
                        "its settings are numbered and listed beside or below each chart. ",
                        sweep.xIsTime ? "faster" : "cheaper")
          : "",
      sweep.x.pass.empty() || sweep.exactTimesTaken ? "" : "Bars are 95 % intervals of the median time. ",
      charts.ownRanges ? "Panels have ranges of their own: their values lie far apart. " : "");
  out += renderLegend(sweep) + "<div class=\"panels\">\n";
  for (size_t index = 0; index < sweep.panels.size(); ++index) {
    const Panel& panel = sweep.panels[index];
    out +=
        "<article class=\"panel\"><h3>" + escapeHtml(panel.title) + "</h3>\n<div class=\"chart-and-list\">";
    out += charts.speed[index].empty() ? "<p>No run of this panel has both values.</p>"
                                       : "<div>" + charts.speed[index] + "</div>" + renderFront(sweep, panel);
    out += "</div></article>\n";
  }
  return out + "</div></section>\n";
}

std::string renderCounter(const Sweep& sweep, const PageCharts& charts) {
  if (!sweep.counter) return "";
  std::string out = fmt::format(
      "<section id=\"counter\"><h2>{} against {}</h2>\n<p>A cost that does not depend on the machine. "
      "Only runs that count it are drawn{}.</p>\n",
      sweep.noVerdict.empty() ? "Error" : escapeHtml(sweep.y.title), escapeHtml(sweep.counter->label()),
      sweep.counterHasFront() ? "; the grey step is the front among them" : "");
  out += renderLegend(sweep) + "<div class=\"panels\">\n";
  for (size_t index = 0; index < sweep.panels.size(); ++index) {
    if (charts.counter[index].empty()) continue;
    out += "<article class=\"panel\"><h3>" + escapeHtml(sweep.panels[index].title) + "</h3>\n" +
           charts.counter[index] + "</article>\n";
  }
  return out + "</div></section>\n";
}

}  // namespace limen::analysis
