// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "analysis/correlations/areas.h"
#include "analysis/correlations/bootstrap_facts.h"
#include "analysis/correlations/calibration_result.h"

namespace limen::analysis {
namespace {

Section sectionOf(const AreaGroup& group, const Areas& all) {
  const std::string level = levelText(all.setting.bootstrap.level);
  const Column drawn = ifAny(interval("bootstrap", level + " bootstrap"));
  const auto bootstrap = [](const auto& one) { return boundsOf(one.bootstrap); };
  Section out;
  out.title = group.name;
  out.fact(key(text("group")), group.name);
  out.fact(integer("rows"), group.rows);
  out.fact(integer("positives", all.outcome + " is 1 in"), group.positives);
  out.fact(all.cluster.empty() ? forData(integer("clusters")) : integer("clusters", "different " + all.cluster),
           group.clusters);
  const auto area = [](auto member) { return [member](const ColumnArea& one) { return one.area.*member; }; };
  out.add(TableOf("areas", "areas under the ROC curve", group.areas)
              .add(text("x"), &ColumnArea::x)
              .add(number("estimate", "area"), area(&RocArea::area))
              .add(interval("", level), area(&RocArea::interval))
              .add(interval("logit", level + " (logit)"), area(&RocArea::logitInterval))
              .add(drawn, bootstrap)
              .add(forData(number("variance")), area(&RocArea::variance)));
  const auto compared = [](auto member) {
    return [member](const AreaDifference& one) { return one.comparison.*member; };
  };
  out.add(TableOf("differences", "differences of areas", group.differences)
              .add(text("first"), &AreaDifference::first)
              .add(text("second", "minus"), &AreaDifference::second)
              .add(number("estimate", "difference"), compared(&RocComparison::difference))
              .add(interval("", level), compared(&RocComparison::interval))
              .add(number("z"), compared(&RocComparison::z))
              .add(probability(), compared(&RocComparison::p))
              .add(ifAny(probability("p_holm", "p (Holm)")), &AreaDifference::holm)
              .add(drawn, bootstrap));
  for (const ColumnCalibration& one : group.calibrations)
    addCalibration(out, one.calibration, one.x, level);
  for (const ColumnArea& one : group.areas)
    if (one.bootstrap && one.bootstrap->undefined > 0) {
      out.notes.push_back(fmt::format("{} samples of the bootstrap had outcomes of one kind and are left out",
                                      one.bootstrap->undefined));
      break;
    }
  out.notes.insert(out.notes.end(), group.notes.begin(), group.notes.end());
  return out;
}

}  // namespace

Result resultOf(const Areas& areas) {
  Result out;
  out.command = "correlate";
  addBootstrapFacts(out.head, areas.cluster, areas.setting.bootstrap);
  out.head.fact(forData(text("outcome")), areas.outcome);
  for (const AreaGroup& group : areas.groups) out.sections.push_back(sectionOf(group, areas));
  out.notes.push_back("area = P(x of a row with " + areas.outcome +
                      " 1 is above x of a row with 0), ties half; intervals and p after DeLong, DeLong and "
                      "Clarke-Pearson (1988), which takes rows as independent; (logit): better next to 0 and 1; "
                      "p (Holm): adjusted for the pairs of a group");
  if (!areas.cluster.empty()) out.notes.push_back(bootstrapNote(areas.cluster));
  out.notes.push_back(kDashNote);
  return out;
}

}  // namespace limen::analysis
