// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"
#include "analysis/sweep/chart.h"
#include "analysis/sweep/page.h"

namespace limen::analysis {
namespace {

constexpr size_t kOpenRows = 20;  // with more pictures only the first panel is unfolded

// One setting of each series: its most exact on the Pareto front, or its most exact at all.
std::vector<size_t> worthShowing(const Sweep& sweep, const Panel& panel) {
  const auto isBetter = [&](const Cell& a, const Cell& b) {
    if ((a.frontNumber > 0) != (b.frontNumber > 0)) return a.frontNumber > 0;
    return sweep.y.higherIsBetter() ? *a.y > *b.y : *a.y < *b.y;
  };
  std::map<size_t, size_t> bySeries;
  for (const size_t index : panel.cells) {
    const Cell& cell = sweep.cells[index];
    if (!cell.isDrawn() || (cell.passes.empty() && cell.run.passes.empty())) continue;
    const auto [entry, fresh] = bySeries.emplace(cell.series, index);
    if (!fresh && isBetter(cell, sweep.cells[entry->second])) entry->second = index;
  }
  std::vector<size_t> shown;
  for (const auto& [series, index] : bySeries) shown.push_back(index);
  return shown;
}

double timeOfPasses(const Cell& cell) {
  double sum = 0.0;
  for (const PassTime& pass : cell.passes) sum += pass.ms.median;
  return sum;
}

double timeOf(const Cell& cell) {
  return std::max(timeOfPasses(cell), cell.frame ? cell.frame->median : 0.0);
}

// Each hue is the golden angle from the one before, so that any number of passes differ; after eight, whose
// hues come close to each other, they get lighter or darker too (the style sheet).
std::string passColour(const std::vector<std::string>& names, const std::string& pass) {
  const auto place = static_cast<size_t>(std::find(names.begin(), names.end(), pass) - names.begin());
  return fmt::format("--hue:{:.0f};--step:{}", std::fmod(210.0 + 137.508 * static_cast<double>(place), 360.0),
                     place / 8 % 3);
}

std::string renderPassLegend(const std::vector<std::string>& names) {
  std::string out = "<ul class=\"pass-legend\" aria-label=\"Passes\">";
  for (const std::string& name : names)
    out += fmt::format("<li><i class=\"pass\" style=\"{}\"></i>{}</li>", passColour(names, name),
                       escapeHtml(name));
  return out + "<li><i class=\"rest\"></i>between passes</li></ul>\n";
}

// Shares of the frame, not times: costs of one panel spread over decades, and a short bar shows nothing.
std::string renderBar(const Cell& cell, const std::vector<std::string>& names) {
  std::string out = "<div class=\"bar\">";
  const auto segment = [&](const std::string& name, const char* look, const std::string& colour, double ms) {
    const double percent = 100.0 * ms / timeOf(cell);
    const std::string text = fmt::format("{}: {} ms, {:.0f} %", name, formatNumber(ms), percent);
    out += fmt::format("<span class=\"{}\" style=\"width:{:.2f}%;{}\" title=\"{}\">{}</span>", look, percent,
                       colour, escapeHtml(text), percent > 9.0 ? escapeHtml(name) : "");
  };
  for (const PassTime& pass : cell.passes)
    segment(pass.pass, "pass", passColour(names, pass.pass), pass.ms.median);
  const double rest = timeOf(cell) - timeOfPasses(cell);
  if (rest > 0.005 * timeOf(cell)) segment("between passes", "rest", "", rest);
  return out + "</div>";
}

std::string renderPicture(const Picture& picture, const PictureRow& row, const std::string& alt,
                          std::set<std::string>& embedded) {
  // A picture that several rows share (the reference) is embedded once and drawn again from there.
  const std::string box =
      fmt::format("viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\"", row.width, row.height);
  const std::string content = embedded.insert(picture.id).second
                                  ? fmt::format("<image id=\"{}\" width=\"{}\" height=\"{}\" href=\"{}\"/>",
                                                picture.id, row.width, row.height, picture.dataUri)
                                  : fmt::format("<use href=\"#{}\"/>", picture.id);
  return fmt::format(
      "<figure><div class=\"lens\"><svg {} role=\"img\" "
      "aria-label=\"{}\">{}</svg></div><figcaption>{}{}</figcaption></figure>\n",
      box, escapeHtml(alt), content, escapeHtml(picture.caption),
      picture.white.empty()
          ? ""
          : "<span class=\"colour-bar\">0 <i></i> " + escapeHtml(picture.white) + "</span>");
}

}  // namespace

std::string renderPasses(const Sweep& sweep) {
  std::vector<std::string> names;
  for (const Panel& panel : sweep.panels)
    for (const size_t index : worthShowing(sweep, panel))
      for (const PassTime& pass : sweep.cells[index].passes) indexIn(names, pass.pass);
  std::string body;
  std::vector<PassRow> rows;
  for (const Panel& panel : sweep.panels) {
    const std::vector<size_t> shown = worthShowing(sweep, panel);
    if (shown.empty()) continue;
    body += "<article class=\"panel\"><h3>" + escapeHtml(panel.title) + "</h3>\n<div class=\"bars-list\">";
    for (const size_t index : shown) {
      const Cell& cell = sweep.cells[index];
      for (PassRow& row : passRows(cell)) rows.push_back(std::move(row));
      if (cell.passes.empty()) continue;
      body += fmt::format("<div class=\"bar-row\"><div>{}</div>{}<div class=\"total\">{} ms</div></div>\n",
                          renderCellName(sweep, cell), renderBar(cell, names), formatNumber(timeOf(cell)));
    }
    body += "</div></article>\n";
  }
  if (rows.empty()) return "";
  TableOf table("passes", "", rows);
  if (sweep.panels.size() > 1)
    table.add(html(sweep.names.heading(sweep.panelName)),
              [&](const PassRow& row) { return escapeHtml(sweep.panels[row.cell->panel].title); });
  table.add(html("setting"), [&](const PassRow& row) { return renderCellName(sweep, *row.cell); })
      .add(text("pass"), &PassRow::pass)
      .add(rounded("median_ms", "median (ms)"), at(&PassRow::ms, &Summary::median))
      .add(rounded("p95_ms", "p95 (ms)"), at(&PassRow::ms, &Summary::p95))
      .add(rounded("held", "held (MiB)"),
           [](const PassRow& row) { return static_cast<double>(row.bytesHeld) / kBytesPerMiB; });
  return "<section id=\"passes\"><h2>Where the time goes</h2>\n<p>Share of each pass in the time of a frame "
         "(medians), for the most exact setting of each series on the Pareto front, or of all if none is "
         "there. "
         "Point at a piece for its value. All runs: <a href=\"passes.csv\">passes.csv</a>.</p>\n" +
         renderPassLegend(names) + "<div class=\"panels\">\n" + body +
         "</div>\n<details><summary>As a table, with the memory that passes hold</summary>" + toHtml(table) +
         "</details></section>\n";
}

std::string renderPictures(const Sweep& sweep, const Pictures& pictures) {
  if (pictures.note.empty()) return "";
  std::string out =
      "<section id=\"pictures\"><h2>Pictures</h2>\n<p>" + escapeHtml(pictures.note) +
      " Point at a picture to enlarge the same place in all of its panel; press to hold it.</p>\n";
  size_t rows = 0;
  for (const std::vector<PictureRow>& panel : pictures.panels) rows += panel.size();
  std::set<std::string> embedded;
  for (size_t index = 0; index < sweep.panels.size(); ++index) {
    if (pictures.panels[index].empty()) continue;
    const bool open = rows <= kOpenRows || embedded.empty();
    out += fmt::format("<details{}><summary><h3>{}</h3></summary>\n<div class=\"picture-rows\">\n",
                       open ? " open" : "", escapeHtml(sweep.panels[index].title));
    for (const PictureRow& row : pictures.panels[index]) {
      const Cell& cell = sweep.cells[row.cell];
      out += fmt::format(
          "<div class=\"picture-row\" data-series=\"{}\"><p>{} <span class=\"value\">{}, {} {}</span> "
          "<span class=\"why\">{}</span></p><div class=\"trio\">\n",
          cell.series, renderCellName(sweep, cell), escapeHtml(describeTime(sweep, cell, false)),
          escapeHtml(sweep.y.title), escapeHtml(withUnit(*cell.y, sweep.y)), escapeHtml(row.chosen));
      for (const Picture& picture : row.pictures)
        out += renderPicture(picture, row,
                             picture.caption + " of " + sweep.label(cell) + ", " + sweep.panels[index].title,
                             embedded);
      out += "</div><p class=\"why\">" +
             escapeHtml(row.window + (row.window.empty() ? "" : ". ") + row.note) + "</p></div>\n";
    }
    out += "</div></details>\n";
  }
  return out + "</section>\n";
}

}  // namespace limen::analysis
