// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"
#include "analysis/sweep/chart.h"
#include "analysis/sweep/grouping.h"
#include "analysis/sweep/page.h"
#include "analysis/sweep/power_law.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

void addParameter(TableOf<Cell>& table, const Sweep& sweep, const Axis& parameter) {
  const auto value = [name = parameter.name](const Cell& cell) {
    const auto found = cell.varying.find(name);
    return found == cell.varying.end() ? std::string() : found->second;
  };
  const bool numeric = std::all_of(sweep.cells.begin(), sweep.cells.end(), [&](const Cell& cell) {
    return value(cell).empty() || finiteNumber(value(cell));
  });
  if (numeric)
    table.add(rounded(parameter.name, parameter.label()),
              [&](const Cell& cell) { return finiteNumber(value(cell)); });
  else
    table.add(text(parameter.name, parameter.label()), value);
}

/// Times first, then errors, counters and the rest; without the two that the charts show.
void addMeasurements(TableOf<Cell>& table, const Sweep& sweep) {
  std::vector<const store::QuantityRow*> seen;
  for (const Cell& cell : sweep.cells)
    for (const store::Measurement& m : cell.run.measurements)
      if (const store::QuantityRow* row = sweep.names.descriptions().quantity(m.name);
          m.name != sweep.x.name && m.name != sweep.y.name &&
          std::find(seen.begin(), seen.end(), row) == seen.end())
        seen.push_back(row);
  const auto rank = [](const store::QuantityRow* row) {
    return row->kind == "time" ? 0 : row->kind == "error" ? 1 : row->kind == "counter" ? 2 : 3;
  };
  std::stable_sort(seen.begin(), seen.end(), [&](auto* a, auto* b) { return rank(a) < rank(b); });
  for (const store::QuantityRow* row : seen) {
    const bool bytes = row->unit == "byte";
    const std::string title = sweep.names.axis(row->name, sweep.software).title;
    table.add(ifAny(rounded(row->name, titleWithUnit(title, bytes ? "MiB" : row->unit))),
              [&](const Cell& cell) {
                const std::optional<double> value = measurementOf(cell.run, row->name);
                return value ? ResultCell(*value * (bytes ? 1.0 / kBytesPerMiB : 1.0)) : ResultCell();
              });
  }
}

/// What tells runs apart and what the charts show come first, so that error stands beside time.
ResultTable runTable(const Sweep& sweep) {
  TableOf table("runs", "", sweep.cells);
  if (sweep.panels.size() > 1)
    table.add(html(sweep.names.heading(sweep.panelName)),
              [&](const Cell& cell) { return escapeHtml(sweep.panels[cell.panel].title); });
  Column technique = html("Technique");
  technique.name = "technique";
  table.add(technique, [&](const Cell& cell) {
    return markerSvg(cell.series) + breakable(cell.run.technique.substr(sweep.seriesPrefix.size()));
  });
  table.add(rounded(sweep.x.name, sweep.x.label()), &Cell::x)
      .add(rounded(sweep.y.name, sweep.y.label()), &Cell::y)
      .add(ifAny(rounded("front", "Front")), [](const Cell& cell) {
        return cell.frontNumber > 0 ? ResultCell(cell.frontNumber) : ResultCell();
      });
  for (const Axis& parameter : sweep.varyingColumns)
    if (parameter.name != sweep.x.name) addParameter(table, sweep, parameter);
  table.add(ifAny(rounded("frame_low95_ms", "95 % low (ms)")), at(&Cell::interval, &MedianInterval::low))
      .add(ifAny(rounded("frame_high95_ms", "95 % high (ms)")), at(&Cell::interval, &MedianInterval::high))
      .add(ifAny(rounded("frame_p95_ms", "95th percentile (ms)")), at(&Cell::frame, &Summary::p95))
      .add(ifAny(rounded("n_frames", "Frames")), at(&Cell::frame, &Summary::n));
  addMeasurements(table, sweep);
  return table;
}

/// Takes out numbers that are the same in all rows, and says them: "Frames 18, Non-finite values 0".
std::string foldConstants(ResultTable& table) {
  std::string folded;
  if (table.rows() < 2) return folded;
  std::erase_if(table.columns, [&](const Column& column) {
    if (!column.isNumber() || column.cells.front().empty()) return false;
    const std::string first = cellText(column, column.cells.front());
    for (const ResultCell& cell : column.cells)
      if (cell.empty() || cellText(column, cell) != first) return false;
    folded += (folded.empty() ? "" : ", ") + escapeHtml(column.title) + " " + escapeHtml(first);
    return true;
  });
  return folded;
}

using Facts = std::vector<std::pair<std::string, std::string>>;

void flattenFacts(const nlohmann::json& value, const std::string& path, Facts& out) {
  if (value.is_object())
    for (const auto& [key, child] : value.items())
      flattenFacts(child, path.empty() ? key : path + " · " + key, out);
  else
    out.emplace_back(path, value.is_string() ? value.get<std::string>() : value.dump());
}

std::string section(const std::string& id, const std::string& title, const std::string& body) {
  return body.empty() ? "" : "<section id=\"" + id + "\"><h2>" + title + "</h2>\n" + body + "</section>\n";
}

}  // namespace

std::string renderRunTable(const Sweep& sweep) {
  HtmlOptions options;
  options.attributes = " class=\"sortable\"";
  options.box = "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"All runs\">";
  options.caption = counted(sweep.cells.size(), "finished run") +
                    "; numbers to four digits, in full in <a href=\"runs.csv\">runs.csv</a>.";
  if (sweep.noVerdict.empty()) options.caption += " “Front”: place on the Pareto front of its panel.";
  options.sortable = true;
  options.ofRow = [&](size_t row) {
    return fmt::format(" data-run=\"{}\" data-series=\"{}\"", escapeHtml(sweep.cells[row].run.key),
                       sweep.cells[row].series);
  };
  if (sweep.cells.empty()) return "";
  ResultTable table = runTable(sweep);
  const std::string folded = foldConstants(table);
  return section("runs", "All runs",
                 "<p>Press a heading to sort by it, again to turn the order." +
                     (folded.empty() ? "" : " <b>The same in all runs:</b> " + folded + ".") + "</p>\n" +
                     toHtml(table, options));
}

std::string renderScalings(const Sweep& sweep) {
  const std::vector<Scaling> scalings = findScalings(sweep);
  if (scalings.empty()) return "";
  std::vector<std::string> names;
  for (const std::string& name : fittedOver(sweep)) names.push_back("<code>" + escapeHtml(name) + "</code>");
  return section(
      "scalings", "How it grows",
      "<p>" + escapeHtml(sweep.y.label()) + " = factor × (" + escapeHtml(sweep.x.label()) +
          ")<sup>exponent</sup>, by least squares of the logarithms over runs that differ in " + join(names) +
          " alone. The interval is Student’s t with n − 2 degrees of freedom, as if departures from the line "
          "were chance; where the largest of them is far from 1, the growth is no power law. In full: <a "
          "href=\"scalings.csv\">scalings.csv</a>.</p>\n" +
          toHtml(tableOf(sweep, scalings)));
}

/// How references were made where that was left open, with the runs compared with each.
std::string referenceRemarks(const Sweep& sweep) {
  std::map<std::string, size_t> runs;
  for (const Cell& cell : sweep.cells)
    if (cell.run.sceneFacts.contains("reference_remarks"))
      for (const nlohmann::json& remark : cell.run.sceneFacts.at("reference_remarks"))
        ++runs[remark.get<std::string>()];
  std::string out;
  for (const auto& [remark, count] : runs)
    out += "<p><b>Reference of " + counted(count, "run") + ":</b> " + escapeHtml(remark) + "</p>\n";
  return out;
}

std::string renderRemarks(const Sweep& sweep) {
  std::vector<const Cell*> cells;
  for (const Cell& cell : sweep.cells)
    if (cell.run.sceneFacts.contains("remarks")) cells.push_back(&cell);
  return section(
      "remarks", "What techniques chose by themselves",
      toHtml(TableOf("remarks", "", cells)
                 .add(html("run"), [&](const Cell* cell) { return renderCellName(sweep, *cell); })
                 .add(text("in"), [&](const Cell* cell) { return sweep.panels[cell->panel].title; })
                 .add(html("chosen, and why"),
                      [](const Cell* cell) {
                        std::string out = "<ul>";
                        for (const nlohmann::json& remark : cell->run.sceneFacts.at("remarks"))
                          out += "<li>" + escapeHtml(remark.get<std::string>()) + "</li>";
                        return out + "</ul>";
                      })) +
          referenceRemarks(sweep));
}

std::string renderProblems(const Sweep& sweep) {
  struct Problem {
    std::string key, scene, technique, label, what;
  };
  std::vector<Problem> problems;
  for (const store::Run& run : sweep.failed)
    problems.push_back({run.key, run.scene, run.technique, run.label, "failed: " + run.error});
  for (const store::PlanEntry& entry : sweep.missing)
    problems.push_back({entry.key, entry.scene, entry.technique, entry.label, "not run, or not finished"});
  const auto technique = [](const Problem& one) {
    return one.label.empty() ? one.technique : one.technique + ", " + one.label;
  };
  return section("problems", "What is not there",
                 toHtml(TableOf("problems", "", problems)
                            .add(html("run"),
                                 [](const Problem& one) {
                                   return "<code>" + escapeHtml(one.key.substr(0, 12)) + "</code>";
                                 })
                            .add(text("scene"), &Problem::scene)
                            .add(text("technique"), technique)
                            .add(text("what", "what happened"), &Problem::what)));
}

std::string renderExpectations(const Sweep& sweep) {
  const auto stated = [](const store::Expectation& e) { return "<code>" + escapeHtml(e.text) + "</code>"; };
  const auto result = [](const store::Expectation& e) {
    return e.held ? "<span class=\"held\">✓ held</span>" : "<span class=\"broken\">✗ broken</span>";
  };
  return section("expectations", "Expectations",
                 toHtml(TableOf("expectations", "", sweep.expectations)
                            .add(html("as stated"), stated)
                            .add(html("result"), result)
                            .add(text("detail"), &store::Expectation::detail)));
}

std::string renderEnvironment(const Sweep& sweep) {
  if (sweep.environments.empty()) return "";
  std::string out;
  for (const store::Environment& environment : sweep.environments) {
    Facts facts{{"device", environment.device}, {"software renderer", environment.software ? "yes" : "no"}};
    flattenFacts(environment.facts, "", facts);
    std::string command, rows;
    for (const auto& [name, value] : facts)
      if (name == "command")
        command = "<p>Command</p><pre><code>" + escapeHtml(value) + "</code></pre>\n";
      else
        rows +=
            "<tr><th scope=\"row\">" + escapeHtml(name) + "</th><td>" + escapeHtml(value) + "</td></tr>\n";
    out += command + "<div class=\"scroll\"><table class=\"pairs\"><tbody>\n" + rows +
           "</tbody></table></div>\n";
  }
  return section("environment", "Measured with",
                 out + "<details><summary>Descriptor</summary><pre><code>" +
                     escapeHtml(sweep.experiment.descriptor) + "</code></pre></details>\n");
}

}  // namespace limen::analysis
