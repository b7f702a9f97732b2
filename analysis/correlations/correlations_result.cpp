// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <algorithm>

#include "analysis/correlations/cluster_bootstrap.h"
#include "analysis/correlations/correlations.h"
#include "analysis/output/chart_file.h"
#include "analysis/output/text_output.h"
#include "experiments/base/error.h"
#include "experiments/base/gnuplot.h"

namespace limen::analysis {

namespace {

std::string shownName(const std::string& name) {
  static const std::vector<std::string> kShown = {"Kendall tau_a", "Kendall tau_b", "Kendall tau_c",
                                                  "Spearman",      "Pearson",       "Pearson, clamped"};
  const auto& names = coefficientNames();
  return kShown[static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
}

ResultTable coefficientTable(const Relation& relation, const Correlations& all) {
  const std::string level = levelText(all.setting.bootstrap.level);
  const auto of = [](auto member) { return at(&RelationCoefficient::coefficient, member); };
  const auto bootstrap = [](auto member) { return at(&RelationCoefficient::bootstrap, member); };
  return TableOf("coefficients",
                 fmt::format("{} against {}, {} {}", relation.x, relation.y, relation.xs.size(), all.unit),
                 relation.coefficients)
      .add(forData(text("x")), [&](const auto&) { return relation.x; })
      .add(forData(text("y")), [&](const auto&) { return relation.y; })
      .add(forData(integer("n")), [&](const auto&) { return relation.xs.size(); })
      .add(forData(text("coefficient")), &RelationCoefficient::name)
      .add(forPeople(text("", "coefficient")), [](const auto& one) { return shownName(one.name); })
      .add(number("estimate"), of(&Coefficient::value))
      .add(interval("", level), of(&Coefficient::interval))
      .add(forData(number("standard_error")), of(&Coefficient::standardError))
      .add(probability(), &RelationCoefficient::p)
      .add(flag("p_exact", "exact"), when(&RelationCoefficient::p, &RelationCoefficient::exact))
      .add(ifAny(probability("p_holm", "p (Holm)")), &RelationCoefficient::holm)
      .add(ifAny(interval("bootstrap", level + " bootstrap")), bootstrap(&ResampledInterval::interval))
      .add(forData(integer("bootstrap_undefined")), bootstrap(&ResampledInterval::undefined))
      .add(ifAny(text("reason", "none because")), &RelationCoefficient::reason);
}

void addNotes(const Relation& relation, Section& out) {
  const std::string pair = relation.x + " against " + relation.y + ": ";
  const std::string& why = relation.coefficients.front().reason;
  if (!why.empty()) {
    out.notes.push_back(pair + "no coefficients: " + why);
    return;
  }
  if (relation.clamp)
    out.notes.push_back(pair + fmt::format("clamped: {} of {}, lowered to {}", relation.clamped,
                                           relation.xs.size(), formatNumber(*relation.clamp)));
  else if (relation.coefficients.size() == coefficientNames().size())
    out.notes.push_back(pair + "clamped: none, as no rate is 1");
  for (const RelationCoefficient& one : relation.coefficients)
    if (one.bootstrap && one.bootstrap->undefined > 0)
      out.notes.push_back(pair + fmt::format("{} was undefined in {} samples of the bootstrap",
                                             shownName(one.name), one.bootstrap->undefined));
}

Section sectionOf(const CorrelationGroup& group, const Correlations& all) {
  Section out;
  out.title = group.name;
  out.fact(key(text("group")), group.name);
  out.fact(
      all.cluster.empty() ? forData(integer("clusters")) : integer("clusters", "different " + all.cluster),
      group.clusters);
  for (const Relation& relation : group.relations) out.add(coefficientTable(relation, all));
  ResultTable clamps = TableOf("clamps", "", group.relations)
                           .add(text("x"), &Relation::x)
                           .add(text("y"), &Relation::y)
                           .add(number("clamp"), &Relation::clamp)
                           .add(integer("clamped"), &Relation::clamped);
  for (Column& column : clamps.columns) column = forData(column);
  out.add(std::move(clamps));
  for (const Relation& relation : group.relations) addNotes(relation, out);
  out.notes.insert(out.notes.end(), group.notes.begin(), group.notes.end());
  return out;
}

/// A pair of columns with the groups that have it.
struct Panel {
  std::string x, y;
  std::vector<std::pair<size_t, const Relation*>> series;  ///< number of the group
};

std::vector<Panel> panelsOf(const Correlations& correlations) {
  std::vector<Panel> out;
  for (size_t i = 0; i < correlations.groups.size(); ++i)
    for (const Relation& relation : correlations.groups[i].relations) {
      auto panel = std::find_if(out.begin(), out.end(),
                                [&](const Panel& one) { return one.x == relation.x && one.y == relation.y; });
      if (panel == out.end()) panel = out.insert(out.end(), {relation.x, relation.y, {}});
      panel->series.push_back({i, &relation});
    }
  return out;
}

std::string numbersOf(const Relation& relation, bool intervals) {
  std::string out;
  for (const char* name : {"kendall_tau_b", "pearson"})
    for (const RelationCoefficient& one : relation.coefficients) {
      if (one.name != name) continue;
      if (!out.empty()) out += ", ";
      out +=
          std::string(one.name == "pearson" ? "r" : "τ_b") + " = " + fixedText(valueOf(one.coefficient), 2);
      const auto interval = one.bootstrap     ? one.bootstrap->interval
                            : one.coefficient ? one.coefficient->interval
                                              : std::nullopt;
      if (intervals && interval && interval->low < interval->high)
        out += fmt::format(" ({:.2f} to {:.2f})", interval->low, interval->high);
    }
  return out;
}

}  // namespace

Result resultOf(const Correlations& correlations) {
  Result out;
  out.command = "correlate";
  addBootstrapFacts(out.head, correlations.cluster, correlations.setting.bootstrap);
  out.head.fact(forData(text("unit")), correlations.unit);
  for (const CorrelationGroup& group : correlations.groups)
    out.sections.push_back(sectionOf(group, correlations));
  out.notes = correlations.notes;
  out.notes.push_back(
      "intervals: Kendall's value +- z error (tau_a after Samara and Randles 1988, tau_b and tau_c after "
      "Brown and Benedetti 1977), Spearman's and Pearson's by Fisher's z. They and the two-sided p take " +
      correlations.unit +
      " as independent; p (Holm): adjusted for the pairs of a group, each coefficient apart");
  if (!correlations.cluster.empty()) {
    out.notes.push_back(bootstrapNote(correlations.cluster));
    out.notes.push_back("no bootstrap for tau_a and tau_c, which rows drawn twice pull towards 0");
  }
  if (correlations.setting.clamp)
    out.notes.push_back(
        "clamped: x above the least whose rate is 1 are lowered to it (Schwarz 2009, section 10.4.1)");
  out.notes.push_back(kDashNote);
  return out;
}

void drawCorrelations(const Correlations& correlations, const std::string& path) {
  const ChartFile file(path);
  const std::vector<Panel> panels = panelsOf(correlations);
  if (panels.empty()) throw Error("there is nothing to draw", path);
  const PanelGrid grid = arrangePanels(panels.size());
  const bool single = panels.size() == 1;
  const double scale = single ? 1.0 : 0.75;
  std::string script =
      file.head(scale * static_cast<double>(grid.columns), scale * static_cast<double>(grid.rows)) +
      "set autoscale xfix\nset autoscale yfix\nset offsets graph 0.04, graph 0.04, graph 0.04, graph 0.04\n";
  if (!single) script += fmt::format("set multiplot layout {},{}\n", grid.rows, grid.columns);
  std::string data;
  size_t block = 0;
  for (const Panel& panel : panels) {
    const bool several = panel.series.size() > 1;
    script += "set xlabel " + gnuplotQuoted(panel.x) + " noenhanced\nset ylabel " + gnuplotQuoted(panel.y) +
              " noenhanced\nset title " +
              gnuplotQuoted(several ? "" : numbersOf(*panel.series.front().second, true)) +
              " noenhanced\nset key " + (several ? "outside below Left reverse noenhanced" : "off") +
              "\nplot ";
    for (const auto& [group, relation] : panel.series) {
      const std::string& name = correlations.groups[group].name;
      for (size_t i = 0; i < relation->xs.size(); ++i)
        data += fmt::format("{} {}\n", relation->xs[i], relation->ys[i]);
      data += "\n\n";
      const std::string title = (name.empty() ? "" : name + ": ") + numbersOf(*relation, false);
      // See-through, as answers often fall on the same place.
      const std::string colour = kChartColours[group % kChartColours.size()];
      script += fmt::format("{}{} index {} using 1:2 with points pt {} ps 0.8 lc rgb '#60{}' title {}",
                            relation == panel.series.front().second ? "" : ", \\\n  ", file.data(), block++,
                            group / kChartColours.size() % 2 ? 5 : 7, colour.substr(1), gnuplotQuoted(title));
    }
    script += "\n";
  }
  if (!single) script += "unset multiplot\n";
  file.draw(script, data);
}

}  // namespace limen::analysis
