// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/correlations/correlations.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/statistics/multiple_comparisons.h"
#include "perception/psychometrics/random.h"

namespace limen::analysis {
namespace {

/// With two rows every coefficient is 1 or -1.
constexpr size_t kLeastOfPair = 3;
const std::string kTauA = "kendall_tau_a", kTauC = "kendall_tau_c";

/// Why a pair has no coefficients; empty if it has.
std::string whyNone(const Relation& relation) {
  if (relation.xs.size() < kLeastOfPair)
    return fmt::format("{} of {} that are needed at least", relation.xs.size(), kLeastOfPair);
  const auto constant = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [&](double value) { return value == values.front(); });
  };
  if (constant(relation.xs)) return relation.x + " does not vary";
  if (constant(relation.ys)) return relation.y + " does not vary";
  return {};
}

RelationCoefficient coefficientOf(const std::string& name, const std::optional<Correlation>& found) {
  RelationCoefficient out;
  out.name = name;
  if (found) {
    out.coefficient = found->coefficient;
    out.p = found->p;
    out.exact = found->exact;
  } else {
    out.reason = "clamped predictions do not vary";
  }
  return out;
}

/// Values of the coefficients of a resample, in the order of coefficientNames(). Rows that were drawn twice
/// tie with each other, which tau_a and tau_c count as pairs that do not agree: both come out too near 0, so
/// that they have none.
std::vector<std::optional<double>> valuesOf(const std::vector<double>& x, const std::vector<double>& y,
                                            bool clamp) {
  std::vector<std::optional<double>> out = {
      {}, valueOf(kendall(x, y).tauB), {}, valueOf(spearman(x, y)), valueOf(pearson(x, y))};
  if (clamp) out.push_back(valueOf(clampedPearson(x, y).correlation));
  return out;
}

void resample(Relation& relation, const std::vector<size_t>& clusters, const CorrelationSetting& setting) {
  const bool clamp = relation.coefficients.size() == coefficientNames().size();
  const auto of = [&](const std::vector<size_t>& rows) {
    std::vector<double> x, y;
    for (const size_t row : rows) {
      x.push_back(relation.xs[row]);
      y.push_back(relation.ys[row]);
    }
    if (x.size() < 2) return std::vector<std::optional<double>>(relation.coefficients.size());
    return valuesOf(x, y, clamp);
  };
  const std::vector<ResampledInterval> found =
      resampleClusters(clusters, relation.coefficients.size(), of, setting.bootstrap);
  for (size_t i = 0; i < found.size(); ++i)
    if (relation.coefficients[i].coefficient && relation.coefficients[i].name != kTauA &&
        relation.coefficients[i].name != kTauC)
      relation.coefficients[i].bootstrap = found[i];
}

}  // namespace

const std::vector<std::string>& coefficientNames() {
  static const std::vector<std::string> kNames = {kTauA,      "kendall_tau_b", kTauC,
                                                  "spearman", "pearson",       "pearson_clamped"};
  return kNames;
}

void correlate(Relation& relation, const std::vector<size_t>& clusters, const CorrelationSetting& setting) {
  const auto& names = coefficientNames();
  const bool clamp = setting.clamp && relation.rates;
  const std::string why = whyNone(relation);
  if (!why.empty()) {
    for (size_t i = 0; i < names.size() - (clamp ? 0 : 1); ++i) {
      relation.coefficients.push_back({});
      relation.coefficients.back().name = names[i];
      relation.coefficients.back().reason = why;
    }
    return;
  }
  const double level = setting.bootstrap.level;
  const Kendall k = kendall(relation.xs, relation.ys, level);
  const std::optional<Coefficient> taus[] = {k.tauA, k.tauB, k.tauC};
  for (size_t i = 0; i < 3; ++i)
    relation.coefficients.push_back({names[i], taus[i], {}, k.p, {}, k.exact, {}});
  relation.coefficients.push_back(coefficientOf(names[3], spearman(relation.xs, relation.ys, level)));
  relation.coefficients.push_back(coefficientOf(names[4], pearson(relation.xs, relation.ys, level)));
  if (clamp) {
    const ClampedPearson clamped = clampedPearson(relation.xs, relation.ys, level);
    relation.clamp = clamped.clamp;
    relation.clamped = clamped.clamped;
    relation.coefficients.push_back(coefficientOf(names[5], clamped.correlation));
  }
  if (!clusters.empty()) resample(relation, clusters, setting);
}

void adjustGroup(CorrelationGroup& group) {
  if (group.relations.size() < 2) return;
  for (size_t i = 0; i < coefficientNames().size(); ++i) {
    std::vector<std::reference_wrapper<RelationCoefficient>> family;
    for (Relation& relation : group.relations)
      if (i < relation.coefficients.size()) family.push_back(relation.coefficients[i]);
    adjustHolm(family, &RelationCoefficient::p, &RelationCoefficient::holm);
  }
}

Correlations correlateColumns(const std::vector<RelationRows>& groups, const RelationColumns& columns,
                              const CorrelationSetting& setting) {
  Correlations out{setting, columns.cluster, "rows", {}, {}};
  for (const RelationRows& rows : groups) {
    CorrelationGroup group{rows.name, rows.clusterCount, {}, {}};
    CorrelationSetting own = setting;
    own.bootstrap.seed = psychometrics::childSeed(setting.bootstrap.seed, rows.name);
    for (size_t i = 0; i < columns.x.size(); ++i) {
      Relation relation;
      relation.x = columns.x[i];
      relation.y = columns.y;
      relation.xs = rows.x[i];
      relation.ys = rows.y;
      relation.rates = setting.clamp;
      correlate(relation, rows.clusters, own);
      group.relations.push_back(std::move(relation));
    }
    if (!columns.cluster.empty())
      if (const std::string note = noteOnClusters(rows.clusterCount, columns.cluster); !note.empty())
        group.notes.push_back(note);
    adjustGroup(group);
    out.groups.push_back(std::move(group));
  }
  return out;
}

}  // namespace limen::analysis
