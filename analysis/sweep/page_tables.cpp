// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <set>

#include "analysis/output/text_output.h"
#include "analysis/sweep/chart.h"
#include "analysis/sweep/grouping.h"
#include "analysis/sweep/page.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

struct Column {
  std::string name;   ///< as in the CSV tables; "" if it is not there
  std::string title;  ///< with the unit
  bool numeric = false;
  std::function<std::optional<double>(const Cell&)> number;  ///< numeric columns
  std::function<std::string(const Cell&)> html;              ///< the others
};

// As JavaScript's Number() reads it.
std::string numberForScript(double value) {
  if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
  return shortestNumber(value);
}

std::optional<double> toNumber(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return text.empty() || *end != '\0' ? std::nullopt : std::optional(value);
}

Column parameterColumn(const Sweep& sweep, const Axis& parameter) {
  const auto value = [name = parameter.name](const Cell& cell) {
    const auto found = cell.varying.find(name);
    return found == cell.varying.end() ? std::string() : found->second;
  };
  const bool numeric = std::all_of(sweep.cells.begin(), sweep.cells.end(), [&](const Cell& cell) {
    return value(cell).empty() || toNumber(value(cell));
  });
  return {parameter.name, parameter.label(), numeric,
          [value](const Cell& cell) { return toNumber(value(cell)); },
          [value](const Cell& cell) { return escapeHtml(value(cell)); }};
}

std::vector<Column> measurementColumns(const Sweep& sweep) {
  std::vector<const store::QuantityRow*> seen;
  for (const Cell& cell : sweep.cells)
    for (const store::Measurement& m : cell.run.measurements)
      if (const store::QuantityRow* row = sweep.names.descriptions().quantity(m.name);
          std::find(seen.begin(), seen.end(), row) == seen.end())
        seen.push_back(row);
  const auto rank = [](const store::QuantityRow* row) {
    return row->kind == "time" ? 0 : row->kind == "error" ? 1 : row->kind == "counter" ? 2 : 3;
  };
  std::stable_sort(seen.begin(), seen.end(), [&](auto* a, auto* b) { return rank(a) < rank(b); });
  std::vector<Column> out;
  for (const store::QuantityRow* row : seen) {
    const bool bytes = row->unit == "byte";
    const double scale = bytes ? 1.0 / kBytesPerMiB : 1.0;
    out.push_back(
        {row->name,
         titleWithUnit(sweep.names.axis(row->name, sweep.software).title, bytes ? "MiB" : row->unit),
         true,
         [name = row->name, scale](const Cell& cell) -> std::optional<double> {
           for (const store::Measurement& m : cell.run.measurements)
             if (m.name == name && m.value) return *m.value * scale;
           return std::nullopt;
         },
         {}});
  }
  return out;
}

std::vector<Column> columnsOf(const Sweep& sweep) {
  std::vector<Column> columns;
  if (sweep.panels.size() > 1)
    columns.push_back({"", sweep.names.heading(sweep.panelName), false, {}, [&](const Cell& cell) {
                         return escapeHtml(sweep.panels[cell.panel].title);
                       }});
  columns.push_back({"technique", "Technique", false, {}, [&](const Cell& cell) {
                       return markerSvg(cell.series) +
                              breakable(cell.run.technique.substr(sweep.seriesPrefix.size()));
                     }});
  for (const Axis& parameter : sweep.varyingColumns) columns.push_back(parameterColumn(sweep, parameter));
  const bool framed =
      std::any_of(sweep.cells.begin(), sweep.cells.end(), [](const Cell& c) { return c.frame.has_value(); });
  if (framed) {
    const auto frame = [](double Summary::*member) {
      return [member](const Cell& cell) -> std::optional<double> {
        return cell.frame ? std::optional((*cell.frame).*member) : std::nullopt;
      };
    };
    const auto bound = [](double MedianInterval::*member) {
      return [member](const Cell& cell) -> std::optional<double> {
        return cell.interval ? std::optional((*cell.interval).*member) : std::nullopt;
      };
    };
    columns.push_back({"frame_median_ms", "Median (ms)", true, frame(&Summary::median), {}});
    columns.push_back({"frame_low95_ms", "95 % low (ms)", true, bound(&MedianInterval::low), {}});
    columns.push_back({"frame_high95_ms", "95 % high (ms)", true, bound(&MedianInterval::high), {}});
    columns.push_back({"frame_p95_ms", "95th percentile (ms)", true, frame(&Summary::p95), {}});
    columns.push_back({"n_frames",
                       "Frames",
                       true,
                       [](const Cell& cell) -> std::optional<double> {
                         return cell.frame ? std::optional(static_cast<double>(cell.frame->n)) : std::nullopt;
                       },
                       {}});
  }
  for (Column& column : measurementColumns(sweep)) columns.push_back(std::move(column));
  columns.push_back({"",
                     "Front",
                     true,
                     [](const Cell& cell) -> std::optional<double> {
                       return cell.frontNumber > 0 ? std::optional<double>(cell.frontNumber) : std::nullopt;
                     },
                     {}});
  return columns;
}

void flattenFacts(const nlohmann::json& value, const std::string& path,
                  std::vector<std::pair<std::string, std::string>>& out) {
  if (value.is_object()) {
    for (const auto& [key, child] : value.items())
      flattenFacts(child, path.empty() ? key : path + " · " + key, out);
  } else {
    out.emplace_back(path, value.is_string() ? value.get<std::string>() : value.dump());
  }
}

}  // namespace

std::string renderRunTable(const Sweep& sweep) {
  if (sweep.cells.empty()) return "";
  const std::vector<Column> columns = columnsOf(sweep);
  std::string out = fmt::format(
      "<section id=\"runs\"><h2>All runs</h2>\n<p>Press a heading to sort by it, again to turn the "
      "order.</p>\n"
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"All runs\"><table "
      "class=\"sortable\">"
      "<caption>{}; numbers to four digits, in full in <a href=\"runs.csv\">runs.csv</a>. “Front”: place on "
      "the Pareto "
      "front of its panel.</caption>\n<thead><tr>",
      counted(sweep.cells.size(), "finished run"));
  for (const Column& column : columns)
    out += fmt::format("<th scope=\"col\"{}{}><button type=\"button\">{}</button></th>",
                       column.numeric ? " class=\"num\"" : "",
                       column.name.empty() ? "" : " title=\"" + escapeHtml(column.name) + "\"",
                       escapeHtml(column.title));
  out += "</tr></thead>\n<tbody>\n";
  for (const Cell& cell : sweep.cells) {
    out += fmt::format("<tr data-run=\"{}\" data-series=\"{}\">", escapeHtml(cell.run.key), cell.series);
    for (const Column& column : columns) {
      if (!column.numeric) {
        out += "<td>" + column.html(cell) + "</td>";
      } else if (const std::optional<double> value = column.number(cell)) {
        out += fmt::format("<td class=\"num\" data-v=\"{}\">{}</td>", numberForScript(*value),
                           formatNumber(*value));
      } else {
        out += "<td class=\"num\"></td>";
      }
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div></section>\n";
}

std::string renderRemarks(const Sweep& sweep) {
  std::string rows;
  for (const Cell& cell : sweep.cells) {
    const auto remarks = cell.run.sceneFacts.find("remarks");
    if (remarks == cell.run.sceneFacts.end()) continue;
    rows += "<tr><td>" + renderCellName(sweep, cell) + "</td><td>" +
            escapeHtml(sweep.panels[cell.panel].title) + "</td><td><ul>";
    for (const nlohmann::json& remark : *remarks)
      rows += "<li>" + escapeHtml(remark.get<std::string>()) + "</li>";
    rows += "</ul></td></tr>\n";
  }
  if (rows.empty()) return "";
  return "<section id=\"remarks\"><h2>What techniques chose by themselves</h2>\n<div "
         "class=\"scroll\"><table><thead>"
         "<tr><th scope=\"col\">run</th><th scope=\"col\">in</th><th scope=\"col\">chosen, and "
         "why</th></tr></thead>\n"
         "<tbody>\n" +
         rows + "</tbody></table></div></section>\n";
}

std::string renderProblems(const Sweep& sweep) {
  if (sweep.isComplete()) return "";
  std::string out =
      "<section id=\"problems\"><h2>What is not there</h2>\n<div class=\"scroll\"><table>"
      "<thead><tr><th scope=\"col\">run</th><th scope=\"col\">scene</th><th scope=\"col\">technique</th>"
      "<th scope=\"col\">what happened</th></tr></thead>\n<tbody>\n";
  const auto row = [&](const std::string& key, const std::string& scene, const std::string& technique,
                       const std::string& label, const std::string& what) {
    out += fmt::format("<tr><td><code>{}</code></td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                       escapeHtml(key.substr(0, 12)), escapeHtml(scene),
                       escapeHtml(label.empty() ? technique : technique + ", " + label), what);
  };
  for (const store::Run& run : sweep.failed)
    row(run.key, run.scene, run.technique, run.label, "failed: " + escapeHtml(run.error));
  for (const store::PlanEntry& entry : sweep.missing)
    row(entry.key, entry.scene, entry.technique, entry.label, "not run, or not finished");
  return out + "</tbody></table></div></section>\n";
}

std::string renderExpectations(const Sweep& sweep) {
  if (sweep.expectations.empty()) return "";
  std::string out =
      "<section id=\"expectations\"><h2>Expectations</h2>\n<div class=\"scroll\"><table><thead><tr>"
      "<th scope=\"col\">as stated</th><th scope=\"col\">result</th><th scope=\"col\">detail</th></tr>"
      "</thead>\n<tbody>\n";
  for (const store::Expectation& e : sweep.expectations)
    out += fmt::format("<tr><td><code>{}</code></td><td class=\"{}\">{}</td><td>{}</td></tr>\n",
                       escapeHtml(e.text), e.held ? "held" : "broken", e.held ? "✓ held" : "✗ broken",
                       escapeHtml(e.detail));
  return out + "</tbody></table></div></section>\n";
}

std::string renderEnvironment(const Sweep& sweep) {
  if (sweep.environments.empty()) return "";
  std::string out = "<section id=\"environment\"><h2>Measured with</h2>\n";
  for (const store::Environment& environment : sweep.environments) {
    if (environment.facts.contains("command")) {
      const nlohmann::json& command = environment.facts["command"];
      out += "<p>Command</p><pre><code>" +
             escapeHtml(command.is_string() ? command.get<std::string>() : command.dump()) +
             "</code></pre>\n";
    }
    out += "<div class=\"scroll\"><table class=\"pairs\"><tbody>\n";
    std::vector<std::pair<std::string, std::string>> facts{
        {"device", environment.device}, {"software renderer", environment.software ? "yes" : "no"}};
    flattenFacts(environment.facts, "", facts);
    for (const auto& [name, value] : facts)
      if (name != "command")
        out += "<tr><th scope=\"row\">" + escapeHtml(name) + "</th><td>" + escapeHtml(value) + "</td></tr>\n";
    out += "</tbody></table></div>\n";
  }
  out += "<details><summary>Descriptor</summary><pre><code>" + escapeHtml(sweep.experiment.descriptor) +
         "</code></pre></details>\n";
  return out + "</section>\n";
}

}  // namespace limen::analysis
