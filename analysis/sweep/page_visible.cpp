// SPDX-License-Identifier: BSD-3-Clause
// The part of a page that says which settings a viewer could not tell from the reference.
#include <fmt/format.h>

#include "analysis/output/text_output.h"
#include "analysis/sweep/grouping.h"
#include "analysis/sweep/page.h"
#include "analysis/sweep/visible.h"

namespace limen::analysis {
namespace {

std::string valueText(const Cell& cell, const Axis& axis) {
  return withUnit(measurementOf(cell.run, axis.name).value_or(0.0), axis);
}

std::string renderChoice(const Sweep& sweep, const VisibleVerdict& visible,
                         const VisibleVerdict::Measure& measure, const VisibleChoice& choice) {
  const std::string cell = "<td data-level=\"" + escapeHtml(measure.axis.title) + "\">";
  if (!choice.least) return cell + "not measured</td>";
  if (!choice.cheapest) {
    const Cell& least = sweep.cells[*choice.least];
    return cell +
           fmt::format(
               "<span class=\"value\">none</span><span class=\"why\">the least is {}, by {}</span></td>",
               escapeHtml(valueText(least, measure.axis)), escapeHtml(sweep.label(least)));
  }
  const Cell& cheapest = sweep.cells[*choice.cheapest];
  const double cost = *visibleCost(sweep, visible, cheapest);
  const std::string out =
      cell + fmt::format("{}<span class=\"value\">{}</span><span class=\"why\">{}</span>",
                         renderCellName(sweep, cheapest), escapeHtml(withUnit(cost, visible.cost)),
                         escapeHtml(valueText(cheapest, measure.axis)));
  return out + renderTies(sweep, choice.ties) + "</td>";
}

/// The charts' own measure in a sentence for each panel.
std::string renderSentences(const Sweep& sweep, const VisibleVerdict& visible) {
  std::string out;
  for (const VisibleVerdict::Measure& measure : visible.measures) {
    if (measure.axis.name != sweep.y.name) continue;
    for (size_t index = 0; index < sweep.panels.size(); ++index) {
      const VisibleChoice& choice = measure.panels[index];
      if (!choice.least) continue;
      out += "<li><b>" + escapeHtml(sweep.panels[index].title) + "</b>: ";
      if (choice.cheapest) {
        const Cell& cell = sweep.cells[*choice.cheapest];
        out += fmt::format("the cheapest setting below 1 JND is {}: {}, {}. It is ringed in the chart.",
                           escapeHtml(sweep.label(cell)),
                           escapeHtml(withUnit(*visibleCost(sweep, visible, cell), visible.cost)),
                           escapeHtml(valueText(cell, measure.axis)));
      } else {
        const Cell& cell = sweep.cells[*choice.least];
        out += fmt::format("no setting is below 1 JND; the closest is {} with {}.",
                           escapeHtml(sweep.label(cell)), escapeHtml(valueText(cell, measure.axis)));
      }
      out += "</li>\n";
    }
  }
  return out.empty() ? "" : "<ul class=\"prose\">" + out + "</ul>\n";
}

}  // namespace

std::string renderVisible(const Sweep& sweep) {
  const VisibleVerdict visible = findVisible(sweep);
  if (visible.measures.empty()) return "";
  std::string out = fmt::format(
      "<h3>What a viewer would see</h3>\n<p>Differences of 1 JND are just noticeable by the model{}. A "
      "measure "
      "over pixels is silent about the pixels beyond it: where the 95th percentile is below 1 JND, one pixel "
      "in "
      "twenty may still be above.</p>\n",
      visible.displays.empty() ? "" : ", on the display " + escapeHtml(visible.displays));
  out += renderSentences(sweep, visible);
  out += fmt::format(
      "<div class=\"scroll\"><table class=\"verdict visible\"><caption>Cheapest setting below 1 JND. "
      "Cost: {}. ≈: below 1 JND too and not told apart from it in {}.</caption>\n<thead><tr><th "
      "scope=\"col\">{}</th>",
      escapeHtml(visible.cost.title), visible.cost.unit == "ms" ? "time" : "cost",
      escapeHtml(sweep.names.heading(sweep.panelName)));
  for (const VisibleVerdict::Measure& measure : visible.measures)
    out += "<th scope=\"col\">" + escapeHtml(measure.axis.title) + "</th>";
  out += "</tr></thead>\n<tbody>";
  for (size_t index = 0; index < sweep.panels.size(); ++index) {
    out += "<tr><th scope=\"row\">" + escapeHtml(sweep.panels[index].title) + "</th>";
    for (const VisibleVerdict::Measure& measure : visible.measures)
      out += renderChoice(sweep, visible, measure, measure.panels[index]);
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

}  // namespace limen::analysis
