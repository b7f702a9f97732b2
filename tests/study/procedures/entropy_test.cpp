// SPDX-License-Identifier: BSD-3-Clause
// QUEST+ and psi against brute force: every posterior formed, every entropy taken from its definition, in the
// wider type.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "perception/psychometrics/random.h"
#include "study/procedures/procedure.h"

namespace limen::study {
namespace {

using nlohmann::json;
using Real = long double;
using Values = std::vector<double>;

/// A second, plain implementation: likelihood(stimulus, parameters, outcome) and the product of all axes.
struct BruteForce {
  std::vector<Values> stimulusAxes, parameterAxes;
  std::vector<bool> nuisance;
  int outcomes;
  std::function<Real(const Values&, const Values&, int)> likelihood;

  std::vector<Values> stimuli = {}, points = {};
  std::vector<Real> posterior = {};

  static std::vector<Values> product(const std::vector<Values>& axes) {
    std::vector<Values> out = {{}};
    for (const Values& axis : axes) {
      std::vector<Values> longer;
      for (const Values& head : out) {
        for (double value : axis) {
          longer.push_back(head);
          longer.back().push_back(value);
        }
      }
      out = longer;
    }
    return out;
  }

  void start() {
    stimuli = product(stimulusAxes);
    points = product(parameterAxes);
    posterior.assign(points.size(), Real(1) / static_cast<Real>(points.size()));
  }

  std::pair<std::vector<Real>, Real> after(const Values& stimulus, int outcome) const {
    std::vector<Real> out(points.size());
    Real total = 0;
    for (size_t i = 0; i < points.size(); ++i)
      total += out[i] = posterior[i] * likelihood(stimulus, points[i], outcome);
    for (Real& p : out) p /= total;
    return {out, total};
  }

  Real entropy(const std::vector<Real>& p) const {
    std::map<Values, Real> marginal;
    for (size_t i = 0; i < points.size(); ++i) {
      Values key;
      for (size_t d = 0; d < nuisance.size(); ++d) {
        if (!nuisance[d]) key.push_back(points[i][d]);
      }
      marginal[key] += p[i];
    }
    Real sum = 0;
    for (const auto& [key, value] : marginal) sum -= value > 0 ? value * std::log(value) : 0;
    return sum;
  }

  Values best() const {
    std::vector<Real> expected;
    for (const Values& stimulus : stimuli) {
      Real sum = 0;
      for (int outcome = 0; outcome < outcomes; ++outcome) {
        const auto [p, total] = after(stimulus, outcome);
        sum += total * entropy(p);
      }
      expected.push_back(sum);
    }
    Real lowest = expected[0];
    for (Real value : expected) lowest = std::min(lowest, value);
    size_t first = 0;
    while (expected[first] > lowest * (1 + 1e-12L) + 1e-14L) ++first;
    return stimuli[first];
  }
};

// Whole runs of both, with answers drawn from a point of the grid.
void expectSameRun(const json& settings, BruteForce brute, const Values& truth, int trials, uint64_t seed) {
  brute.start();
  const auto procedure = makeProcedure(readProcedure(settings, "run"), seed);
  psychometrics::Random random(seed);
  for (int trial = 0; trial < trials; ++trial) {
    const auto next = procedure->next();
    ASSERT_TRUE(next);
    ASSERT_EQ(*next, brute.best()) << "trial " << trial + 1;
    Real u = random.uniform();
    int outcome = 0;
    while (outcome + 1 < brute.outcomes && u >= brute.likelihood(*next, truth, outcome)) {
      u -= brute.likelihood(*next, truth, outcome);
      ++outcome;
    }
    procedure->update(*next, outcome);
    brute.posterior = brute.after(*next, outcome).first;
  }
  const Estimate estimate = procedure->estimate();
  size_t d = 0;
  for (const ParameterEstimate& parameter : estimate.parameters) {
    while (brute.parameterAxes[d].size() == 1) ++d;
    Real mean = 0;
    for (size_t i = 0; i < brute.points.size(); ++i) mean += brute.posterior[i] * brute.points[i][d];
    EXPECT_NEAR(parameter.mean, static_cast<double>(mean), 1e-10) << parameter.name;
    ++d;
  }
}

Values range(double from, double to, double step) {
  Values out;
  for (int i = 0; from + i * step < to + step / 2; ++i) out.push_back(from + i * step);
  return out;
}

Real weibullDb(const Values& x, const Values& s, int outcome) {
  const Real p = 1 - s[3] - (1 - s[2] - s[3]) * std::exp(-std::pow(Real(10), s[1] * Real(x[0] - s[0]) / 20));
  return outcome == 1 ? p : 1 - p;
}

TEST(ExpectedEntropy, QuestPlusAndBruteForceShowTheSameStimuli) {
  const json settings = {{"type", "quest_plus"},
                         {"stimulus", {{"name", "contrast"}, {"values", range(-40, 0, 2)}}},
                         {"parameters",
                          {{"threshold", range(-40, 0, 2)},
                           {"slope", {2, 3, 4, 5}},
                           {"guess", 0.5},
                           {"lapse", {0, 0.02, 0.04}}}},
                         {"stop", {{"trials", 40}}}};
  const BruteForce brute = {{range(-40, 0, 2)},
                            {range(-40, 0, 2), {2, 3, 4, 5}, {0.5}, {0, 0.02, 0.04}},
                            {false, false, false, false},
                            2,
                            weibullDb};
  expectSameRun(settings, brute, {-24, 3, 0.5, 0.02}, 40, 11);
  expectSameRun(settings, brute, {-10, 5, 0.5, 0.04}, 40, 12);
}

TEST(ExpectedEntropy, PsiAndPsiMarginalAndBruteForceShowTheSameStimuli) {
  const Values stimuli = range(-3, 3, 0.25), thresholds = range(-2, 2, 0.25), slopes = {0.5, 1, 2, 4, 8};
  const auto logistic = [](const Values& x, const Values& s, int outcome) {
    const Real p = s[2] + (1 - s[2] - s[3]) / (1 + std::exp(-Real(s[1]) * (x[0] - s[0])));
    return outcome == 1 ? p : 1 - p;
  };
  json settings = {
      {"type", "psi"},
      {"stimulus", {{"name", "level"}, {"values", stimuli}}},
      {"parameters", {{"threshold", thresholds}, {"slope", slopes}, {"guess", 0.25}, {"lapse", 0.02}}},
      {"stop", {{"trials", 60}}}};
  expectSameRun(settings,
                {{stimuli}, {thresholds, slopes, {0.25}, {0.02}}, {false, false, false, false}, 2, logistic},
                {0.5, 2, 0.25, 0.02}, 60, 3);
  settings["parameters"]["lapse"] = {0.0, 0.03, 0.06};
  settings["nuisance"] = {"slope", "lapse"};
  expectSameRun(
      settings,
      {{stimuli}, {thresholds, slopes, {0.25}, {0.0, 0.03, 0.06}}, {false, true, false, true}, 2, logistic},
      {-0.5, 4, 0.25, 0.03}, 40, 4);
}

Real phi(Real z) { return std::erfc(-z / std::sqrt(Real(2))) / 2; }

TEST(ExpectedEntropy, PairComparisonsAndRatingsAndBruteForceShowTheSameStimuli) {
  const Values magnitudes = {0, 0.25, 0.5, 0.75, 1};
  const json thurstone = {
      {"type", "quest_plus"},
      {"model", "thurstone"},
      {"stimulus",
       {{{"name", "first"}, {"values", magnitudes}}, {{"name", "second"}, {"values", magnitudes}}}},
      {"parameters",
       {{"maximum", {2, 4, 6, 8}}, {"threshold", {0, 0.1, 0.2}}, {"power", {0.5, 1, 2}}, {"lapse", 0.01}}},
      {"stop", {{"trials", 40}}}};
  const auto comparison = [](const Values& x, const Values& s, int outcome) {
    const auto scale = [&s](Real v) {
      return s[0] * std::pow(std::max(Real(0), v - s[1]) / (1 - Real(s[1])), Real(s[2]));
    };
    const Real p = s[3] + (1 - 2 * Real(s[3])) * phi((scale(x[0]) - scale(x[1])) / std::sqrt(Real(2)));
    return outcome == 1 ? p : 1 - p;
  };
  expectSameRun(thurstone,
                {{magnitudes, magnitudes},
                 {{2, 4, 6, 8}, {0, 0.1, 0.2}, {0.5, 1, 2}, {0.01}},
                 {false, false, false, false},
                 2,
                 comparison},
                {6, 0.1, 0.5, 0.01}, 40, 5);
  const json rating = {{"type", "quest_plus"},
                       {"model", "rating"},
                       {"categories", 4},
                       {"stimulus", {{"name", "quality"}, {"values", range(0, 5, 0.5)}}},
                       {"parameters",
                        {{"sd", {0.3, 0.6, 1.2}},
                         {"criterion_1", {0.5, 1, 1.5}},
                         {"step_2", {0.5, 1, 2}},
                         {"step_3", {0.5, 1, 2}}}},
                       {"stop", {{"trials", 40}}}};
  const auto category = [](const Values& x, const Values& s, int outcome) {
    const Real criteria[] = {s[1], Real(s[1]) + s[2], Real(s[1]) + s[2] + s[3]};
    const Real above = outcome == 0 ? 1 : phi((x[0] - criteria[outcome - 1]) / s[0]);
    return above - (outcome == 3 ? 0 : phi((x[0] - criteria[outcome]) / s[0]));
  };
  expectSameRun(rating,
                {{range(0, 5, 0.5)},
                 {{0.3, 0.6, 1.2}, {0.5, 1, 1.5}, {0.5, 1, 2}, {0.5, 1, 2}},
                 {false, false, false, false},
                 4,
                 category},
                {0.6, 1, 1, 2}, 40, 6);
}

TEST(ExpectedEntropy, OfEqualStimuliTheFirstDeclaredIsShown) {
  // Stimulus 0 says nothing of the state; 1 and 2 say the same, with outcomes exchanged, so that sums round
  // differently.
  const json settings = {{"type", "quest_plus"},
                         {"model", "table"},
                         {"stimulus", {0, 1, 2}},
                         {"parameters", {{"state", {0, 1, 2}}}},
                         {"probabilities",
                          {{{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}},
                           {{0.1, 0.9}, {0.3, 0.7}, {0.8, 0.2}},
                           {{0.9, 0.1}, {0.7, 0.3}, {0.2, 0.8}}}},
                         {"stop", {{"trials", 5}}}};
  EXPECT_EQ(makeProcedure(readProcedure(settings, ""), 1)->next(), Values{1});
  json swapped = settings;
  std::swap(swapped["probabilities"][1], swapped["probabilities"][2]);
  EXPECT_EQ(makeProcedure(readProcedure(swapped, ""), 1)->next(), Values{1});
}

TEST(ExpectedEntropy, MinNEntropyPicksAmongTheBestBySeed) {
  json settings = {{"type", "quest_plus"},
                   {"stimulus", {{"name", "contrast"}, {"values", range(-40, 0, 2)}}},
                   {"parameters", {{"threshold", range(-40, 0, 2)}, {"slope", 3.5}}},
                   {"select", "min_n_entropy"},
                   {"candidates", 3},
                   {"stop", {{"trials", 5}}}};
  BruteForce brute = {{range(-40, 0, 2)},
                      {range(-40, 0, 2), {3.5}, {0.5}, {0.02}},
                      {false, false, false, false},
                      2,
                      weibullDb};
  brute.start();
  std::vector<Values> best;  // found one after the other, each taken out
  for (int i = 0; i < 3; ++i) {
    best.push_back(brute.best());
    std::erase(brute.stimuli, best.back());
  }
  const ProcedureSettings read = readProcedure(settings, "");
  std::map<double, int> counts;
  for (uint64_t seed = 0; seed < 300; ++seed) ++counts[makeProcedure(read, seed)->next()->front()];
  ASSERT_EQ(counts.size(), 3u);
  for (const Values& stimulus : best) EXPECT_NEAR(counts[stimulus[0]], 100, 5 * std::sqrt(300 * 2.0 / 9));
}

}  // namespace
}  // namespace limen::study
