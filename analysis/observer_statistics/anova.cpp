// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/observer_statistics/anova.h"

#include <cassert>
#include <cmath>
#include <map>
#include <set>

#include "analysis/statistics/multiple_comparisons.h"

namespace limen::analysis {
namespace {

/// Cells of a design; more than any data can fill come out as that.
size_t cellsOf(const std::vector<NamedFactor>& factors) {
  constexpr size_t kMany = 1'000'000'000;
  size_t cells = 1;
  for (const NamedFactor& factor : factors) {
    if (factor.levels.size() > kMany / cells) return kMany;
    cells *= factor.levels.size();
  }
  return cells;
}

/// The first cell in the design's order that is not among `seen`.
std::vector<size_t> firstMissing(const std::vector<NamedFactor>& factors,
                                 const std::set<std::vector<size_t>>& seen) {
  std::vector<size_t> cell(factors.size(), 0);
  while (seen.count(cell) > 0)
    for (size_t f = factors.size(); f-- > 0;) {
      if (++cell[f] < factors[f].levels.size()) break;
      cell[f] = 0;
    }
  return cell;
}

void transformRates(RepeatedMeasures& data) {
  for (double& value : data.values) {
    assert(value >= 0.0 && value <= 1.0);
    value = std::asin(std::sqrt(value));
  }
}

FactorComparison compareLevels(const RepeatedMeasures& data, size_t factor, bool ranks, bool rates) {
  FactorComparison out;
  const std::vector<std::vector<double>> means = levelMeans(data, factor);
  for (const std::vector<double>& level : means)
    out.means.push_back(rates ? meanRateOverSubjects(level) : meanOverSubjects(level));
  out.pairs = comparePairs(data, factor);
  if (!ranks) return out;
  std::vector<double> bySubject;
  for (size_t subject = 0; subject < data.subjects; ++subject)
    for (const std::vector<double>& level : means) bySubject.push_back(level[subject]);
  out.friedman = friedmanTest(bySubject, data.subjects, means.size());
  for (size_t first = 0; first < means.size(); ++first)
    for (size_t second = first + 1; second < means.size(); ++second)
      out.rankPairs.push_back({first, second, signedRankTest(means[first], means[second]), 1.0});
  adjustHolm(
      out.rankPairs, [](const RankComparison& pair) { return pair.test.p; }, &RankComparison::pHolm);
  return out;
}

}  // namespace

std::vector<IncompleteSubject> incompleteSubjects(const GroupObservations& data) {
  std::vector<std::set<std::vector<size_t>>> seen(data.subjects.size());
  for (const CellObservation& one : data.observations) seen[one.subject].insert(one.levels);
  const size_t cells = cellsOf(data.factors);
  std::vector<IncompleteSubject> out;
  for (size_t subject = 0; subject < seen.size(); ++subject)
    if (seen[subject].size() < cells)
      out.push_back({subject, cells - seen[subject].size(), firstMissing(data.factors, seen[subject])});
  return out;
}

std::string cellName(const std::vector<NamedFactor>& factors, const std::vector<size_t>& levels) {
  std::string out;
  for (size_t f = 0; f < factors.size(); ++f)
    out += (f > 0 ? ", " : "") + factors[f].name + "=" + factors[f].levels[levels[f]];
  return out;
}

void analyseGroup(PartAnova& out, const GroupObservations& data, const AnovaSettings& settings) {
  out.factors = data.factors;
  out.transform = settings.transform;
  std::set<size_t> left;
  for (const IncompleteSubject& one : incompleteSubjects(data)) {
    left.insert(one.subject);
    out.incomplete.push_back(data.subjects[one.subject]);
  }
  std::map<size_t, size_t> subjects;
  for (size_t subject = 0; subject < data.subjects.size(); ++subject)
    if (left.count(subject) == 0) subjects.emplace(subject, subjects.size());
  if (subjects.size() < 2) {
    out.note = "fewer than two subjects have a value in every condition";
    return;
  }
  std::vector<WithinFactor> factors;
  for (const NamedFactor& factor : data.factors) factors.push_back({factor.name, factor.levels.size()});
  std::vector<CellObservation> observations;
  for (const CellObservation& one : data.observations)
    if (const auto subject = subjects.find(one.subject); subject != subjects.end()) {
      observations.push_back(one);
      observations.back().subject = subject->second;
    }
  RepeatedMeasures cells = averageCells(factors, subjects.size(), observations);
  out.unequalReplicates = cells.unequalReplicates;
  if (settings.transform == RateTransform::Arcsine) transformRates(cells);
  out.result = analyseRepeatedMeasures(cells);
  out.published.resize(out.result->effects.size());
  for (size_t factor = 0; factor < factors.size(); ++factor)
    out.comparisons.push_back(
        compareLevels(cells, factor, settings.ranks, out.rates && settings.transform == RateTransform::None));
}

}  // namespace limen::analysis
