// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "analysis/output/text_output.h"
#include "analysis/sweep/page.h"

namespace limen::analysis {
namespace {

/// Levels that name the same settings in every panel, as one column.
struct LevelColumn {
  double first, last;
  /// "up to 1.5 ×"
  std::string heading() const {
    const std::string end = formatNumber(last) + " ×";
    if (first == last) return first == 1.0 ? "the least" : "up to " + end;
    return first == 1.0 ? "up to " + end : formatNumber(first) + " to " + end;
  }
};

const TradeOffVerdict::Level* levelOf(const Panel& panel, double factor) {
  for (const TradeOffVerdict::Level& level : panel.verdict.levels)
    if (level.first <= factor && factor <= level.last) return &level;
  return nullptr;
}

std::vector<LevelColumn> columnsOf(const Sweep& sweep) {
  std::vector<LevelColumn> columns;
  for (const double factor : kErrorLevels) {
    const bool same =
        !columns.empty() && std::all_of(sweep.panels.begin(), sweep.panels.end(), [&](auto& panel) {
          return levelOf(panel, factor) == levelOf(panel, columns.back().last);
        });
    if (same)
      columns.back().last = factor;
    else
      columns.push_back({factor, factor});
  }
  return columns;
}

/// "0.0123, 1.4 times the least": the least as it is.
std::string renderError(const Sweep& sweep, const Cell& cell, const Panel& panel) {
  std::string out = escapeHtml(sweep.y.title + " " + withUnit(*cell.y, sweep.y));
  const double least = sweep.comparableError(sweep.cells[panel.front.back()]);
  const double times = sweep.comparableError(cell) / least;
  if (least > 0.0 && times > 1.0) out += ", " + fmt::format("{:.3g}", times) + " times the least";
  return out;
}

std::string renderWinner(const Sweep& sweep, const Panel& panel, const TradeOffVerdict::Level& level,
                         const std::string& heading, size_t span) {
  const Cell& winner = sweep.cells[level.cheapest];
  std::string out = fmt::format(
      "<td data-level=\"{}\"{}>{}<span class=\"value\">{}</span><span class=\"why\">{}</span>", heading,
      span > 1 ? fmt::format(" colspan=\"{}\"", span) : "", renderCellName(sweep, winner),
      escapeHtml(describeTime(sweep, winner, false)), renderError(sweep, winner, panel));
  return out + renderTies(sweep, level.ties) + "</td>";
}

std::string renderMatrix(const Sweep& sweep) {
  const std::vector<LevelColumn> columns = columnsOf(sweep);
  std::string out = fmt::format(
      "<div class=\"scroll\"><table class=\"verdict\"><caption>{} setting whose error ({}) is within a "
      "multiple of "
      "the panel's least. ≈: not told apart from it in {}.</caption>\n<thead><tr><th "
      "scope=\"col\">{}</th>",
      sweep.xIsTime ? "Fastest" : "Cheapest", escapeHtml(sweep.y.title), sweep.xIsTime ? "time" : "cost",
      escapeHtml(sweep.names.heading(sweep.panelName)));
  for (const LevelColumn& column : columns) out += "<th scope=\"col\">" + column.heading() + "</th>";
  out += "</tr></thead>\n<tbody>";
  for (const Panel& panel : sweep.panels) {
    if (panel.front.empty()) continue;
    out += "<tr><th scope=\"row\">" + escapeHtml(panel.title) + "</th>";
    for (size_t at = 0; at < columns.size();) {
      const TradeOffVerdict::Level* level = levelOf(panel, columns[at].first);
      size_t end = at + 1;
      while (end < columns.size() && levelOf(panel, columns[end].first) == level) ++end;
      const LevelColumn whole{columns[at].first, columns[end - 1].last};
      out += renderWinner(sweep, panel, *level, whole.heading(), end - at);
      at = end;
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

/// "3 of a, 2 of b", most first.
std::string countBySeries(const Sweep& sweep, const std::vector<size_t>& cells) {
  std::vector<size_t> count(sweep.series.size()), order;
  for (const size_t index : cells)
    if (count[sweep.cells[index].series]++ == 0) order.push_back(sweep.cells[index].series);
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return count[a] > count[b]; });
  std::string out;
  for (const size_t series : order)
    out +=
        fmt::format("{}{} of {}", out.empty() ? "" : ", ", count[series], escapeHtml(sweep.series[series]));
  return out;
}

/// Series all of whose settings are beaten.
std::string beatenSeries(const Sweep& sweep, const Panel& panel) {
  std::vector<bool> drawn(sweep.series.size()), open(sweep.series.size());
  for (const size_t index : panel.cells) {
    const Cell& cell = sweep.cells[index];
    if (!cell.isDrawn()) continue;
    drawn[cell.series] = true;
    open[cell.series] = open[cell.series] || !cell.beaten;
  }
  std::string out;
  for (size_t series = 0; series < drawn.size(); ++series)
    if (drawn[series] && !open[series]) out += (out.empty() ? "" : ", ") + escapeHtml(sweep.series[series]);
  return out;
}

std::string renderSentence(const Sweep& sweep, const Panel& panel) {
  const std::string head = "<b>" + escapeHtml(panel.title) + "</b>: ";
  if (panel.front.empty()) return head + "nothing to compare, no run has both values.";
  const auto settings = std::count_if(panel.cells.begin(), panel.cells.end(),
                                      [&](size_t index) { return sweep.cells[index].isDrawn(); });
  if (settings == 1) return head + "one setting alone, with nothing to compare it with.";
  const std::vector<size_t>& worth = panel.verdict.worth;
  std::string out = head + fmt::format("worth {} {} {} of {} settings: {}.",
                                       worth.size() == 1 ? "its" : "their", sweep.xIsTime ? "time" : "cost",
                                       worth.size() == 1 ? "is 1" : fmt::format("are {}", worth.size()),
                                       settings, countBySeries(sweep, worth));
  if (panel.verdict.knee) {
    const Cell& knee = sweep.cells[*panel.verdict.knee];
    out += fmt::format(" The knee is {}: {}, {}.", escapeHtml(sweep.label(knee)),
                       escapeHtml(describeTime(sweep, knee, false)), renderError(sweep, knee, panel));
  }
  if (const std::string beaten = beatenSeries(sweep, panel); !beaten.empty())
    out += " Beaten by others in every setting: " + beaten + ".";
  return out;
}

}  // namespace

std::string renderVerdict(const Sweep& sweep) {
  std::string out = "<section id=\"verdict\"><h2>In short</h2>\n";
  if (!sweep.noVerdict.empty()) {
    out += "<p>No setting is called better than another here, and no front is drawn: " +
           escapeHtml(sweep.noVerdict) + ". The charts show how one depends on the other.</p>\n";
  } else {
    if (sweep.exactTimesTaken)
      out +=
          "<p>Some runs were timed for a single frame or without frame times, so how far their times scatter "
          "is "
          "not known: they are compared as if they were exact.</p>\n";
    out += renderMatrix(sweep) + "<ul class=\"prose\">";
    for (const Panel& panel : sweep.panels) out += "<li>" + renderSentence(sweep, panel) + "</li>\n";
    out += "</ul>\n";
  }
  out += renderVisible(sweep);
  const auto undrawn = static_cast<size_t>(std::count_if(sweep.cells.begin(), sweep.cells.end(),
                                                         [](const Cell& cell) { return !cell.isDrawn(); }));
  if (undrawn > 0)
    out += fmt::format("<p>{} {} no value of {} or {} and {} in the table only.</p>", counted(undrawn, "run"),
                       undrawn == 1 ? "has" : "have", escapeHtml(sweep.x.title), escapeHtml(sweep.y.title),
                       undrawn == 1 ? "stands" : "stand");
  return out + "</section>\n";
}

std::string renderVerdictRules(const Sweep& sweep) {
  if (!sweep.noVerdict.empty()) return "";
  double noise = 0.0;
  for (const Panel& panel : sweep.panels) noise = std::max(noise, panel.noise);
  const char* word = sweep.xIsTime ? "time" : "cost";
  std::string out = fmt::format(
      "<li>A setting is <b>worth its {0}</b> if its error is at least {1:.0f} % below that of the next {2} "
      "one that "
      "is, and at least {3:.0f} % for each doubling of the {0}. The <b>knee</b> is the one of these farthest "
      "below "
      "the line between the first and the last, both axes logarithmic. <b>Beaten</b> is what another setting "
      "surely equals in both and betters in one, by intervals and noise.</li>",
      word, 100.0 * kLeastGain, sweep.xIsTime ? "faster" : "cheaper", 100.0 * kGainPerDoubling);
  if (noise > 0.0)
    out += fmt::format(
        "<li>The reference is sampled. Errors that differ by {} or less are not told apart, since its noise "
        "alone "
        "may make such a difference (95 %).</li>",
        formatNumber(noise));
  return out;
}

}  // namespace limen::analysis
