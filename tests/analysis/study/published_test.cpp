// SPDX-License-Identifier: BSD-3-Clause
// What the thesis printed, checked against itself, and set beside answers.
#include "analysis/study/published.h"
#include "analysis/output/result_renderers.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "analysis/study/published_comparison.h"
#include "tests/analysis/study/hand_made.h"
#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;

const PublishedDesign& designOf(const std::string& protocol) {
  for (const PublishedDesign& one : publishedDesigns())
    if (one.protocol == protocol) return one;
  ADD_FAILURE() << protocol;
  std::abort();
}

/// P(F' > F) as the regularised incomplete beta I_x(df2/2, df1/2), x = df2 / (df2 + df1 F): Simpson's rule
/// over 0..x, where the integrand is smooth for df2 > 2.
double pOf(double f, double df, double dfError) {
  const double a = dfError / 2.0, b = df / 2.0, x = dfError / (dfError + df * f);
  const double logBeta = std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b);
  const auto density = [&](double t) {
    return t <= 0.0 ? 0.0 : std::exp((a - 1.0) * std::log(t) + (b - 1.0) * std::log1p(-t) - logBeta);
  };
  constexpr int kSteps = 20000;
  const double h = x / kSteps;
  double sum = density(0.0) + density(x);
  for (int i = 1; i < kSteps; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * density(i * h);
  return sum * h / 3.0;
}

/// Whether some `n` whole numbers from 0 to `most` have a mean and a standard deviation (over n - lost) that
/// are `mean` and `sd` times `most`, as rounded to `half` either way.
bool isReachable(int n, int most, double mean, double sd, int lost, double half = 0.00005) {
  // For each sum the sums of squares that go with it.
  using Squares = std::bitset<8 * 84 * 84 + 1>;
  std::vector<Squares> sums(static_cast<size_t>(n * most) + 1);
  sums[0].set(0);
  for (int i = 0; i < n; ++i) {
    std::vector<Squares> next(sums.size());
    for (size_t sum = 0; sum <= static_cast<size_t>(i * most); ++sum)
      for (size_t k = 0; k <= static_cast<size_t>(most); ++k) next[sum + k] |= sums[sum] << (k * k);
    sums = std::move(next);
  }
  for (size_t sum = 0; sum < sums.size(); ++sum) {
    const double ownMean = static_cast<double>(sum) / n;
    if (std::abs(ownMean / most - mean) > half * 1.001) continue;
    for (size_t squares = 0; squares < sums[sum].size(); ++squares) {
      if (!sums[sum][squares]) continue;
      const double deviations = static_cast<double>(squares) - ownMean * static_cast<double>(sum);
      if (std::abs(std::sqrt(std::max(0.0, deviations) / (n - lost)) / most - sd) <= half * 1.001)
        return true;
    }
  }
  return false;
}

TEST(Published, IncompleteBetaOfTheTestIsRight) {
  // F(2, 2): P(F' > F) = 1 / (1 + F). F(2, 4): (1 + F/2)^-2.
  EXPECT_NEAR(pOf(3.0, 2, 4), 0.16, 1e-9);
  EXPECT_NEAR(pOf(10.0, 2, 4), 1.0 / 36.0, 1e-9);
}

TEST(Published, DegreesOfFreedomFollowFromTheDesign) {
  const std::map<std::string, int> levels = {
      {"lod_change", 2}, {"switch_distance", 7}, {"presentation", 2}, {"scenario", 8}};
  for (const PublishedEffectOf& one : publishedEffects()) {
    double df = 1.0;
    for (const std::string& factor : one.factors) df *= levels.at(factor) - 1;
    EXPECT_EQ(one.effect.df, df) << one.part;
    EXPECT_EQ(one.effect.dfError, df * (static_cast<double>(designOf(one.protocol).observers) - 1.0))
        << one.part;
  }
  EXPECT_EQ(publishedEffects().size(), 8U);
  // 2 x 7 x 2 scenarios, three times with and once without a change; 2 parts of 8 x 2 with and without.
  EXPECT_EQ(designOf("experiment_1").trialsEach, 28U * 4U);
  EXPECT_EQ(designOf("experiment_2").trialsEach, 2U * 16U * 2U);
}

TEST(Published, PFollowsFromFButOnce) {
  for (const PublishedEffectOf& one : publishedEffects()) {
    const PublishedEffect& effect = one.effect;
    const double p = pOf(effect.f, effect.df, effect.dfError);
    const bool bound = effect.p[0] == '<';
    const double printed = std::stod(bound ? effect.p.substr(1) : effect.p);
    const bool fits = bound ? p < printed : std::abs(p - printed) <= 0.0005;
    // An F with two digits does not give three of p.
    const bool derived = effect.fDerived && std::abs(p - printed) < 0.002;
    const bool known = one.part == "terrain" && one.factors.front() == "presentation";
    EXPECT_EQ(fits || derived, !known) << one.part << " " << one.factors.front() << " " << p;
    if (known) {
      EXPECT_NEAR(p, 0.041, 0.0005);
      EXPECT_THAT(effect.remark, HasSubstr("0.041"));
    }
  }
}

TEST(Published, RatesAreThoseOfSomeAnswers) {
  for (const PublishedRateOf& one : publishedRates()) {
    const int trials = one.protocol == "experiment_2" ? 16 : one.change ? 84 : 28;
    const int observers = static_cast<int>(designOf(one.protocol).observers);
    EXPECT_TRUE(isReachable(observers, trials, one.rate.mean, one.rate.sd, 1))
        << one.protocol << " " << one.part << " " << one.change;
    // Sixteen answers or fewer of each are few enough to tell how it was not divided.
    if (trials == 16) {
      EXPECT_FALSE(isReachable(observers, trials, one.rate.mean, one.rate.sd, 0)) << one.part;
    }
  }
  EXPECT_EQ(publishedRates().size(), 6U);
}

TEST(Published, ScenariosAreSpreadByTheirNumber) {
  // Eight scenarios, each seen by twelve: no eight counts have this SD over n - 1, some have it over n.
  const PublishedScenarios one = *publishedScenario("experiment_2", "terrain", "static");
  EXPECT_FALSE(isReachable(8, 12, one.meanRate, one.sdRate, 1));
  EXPECT_TRUE(isReachable(8, 12, one.meanRate, one.sdRate, 0));
  EXPECT_FALSE(publishedScenario("experiment_2", "object", "static"));
}

class PublishedComparisonTest : public testing::Test {
 protected:
  std::string store() const { return folder_.path("s.sqlite"); }
  PublishedComparison compare() const {
    StudyChoice choice;
    choice.store = store();
    const StudyAnswers study = readStudyAnswers(choice);
    const StudyRates rates = studyRates(study);
    const std::vector<PartAnova> anova = studyAnova(study);
    StudyFindings findings;
    findings.study = &study;
    findings.rates = &rates;
    findings.anova = &anova;
    findings.whyNotValidated = "no predictions";
    return comparePublished(findings);
  }
  static const ComparedStatistic& statistic(const PublishedComparison& all, const std::string& name) {
    for (const ComparedStatistic& one : all.statistics)
      if (one.statistic == name) return one;
    ADD_FAILURE() << name;
    std::abort();
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(PublishedComparisonTest, SpreadOfScenariosByHand) {
  const std::string protocol = "task: {type: yes_no}\nfactors:\n  d: [a, b, c]\n";
  // Rates 1, 1/2, 0 of two observers: mean 1/2, squares 1/2: sd of n sqrt(1/6), with n - 1 one half.
  // Severities 3 and 2 of a, 1 of b: means 5/2 and 1.
  std::vector<HandMadeTrial> first =
      trials({{"d", "a"}}, 1, 1) + trials({{"d", "b"}}, 1, 1) + trials({{"d", "c"}}, 0, 1);
  std::vector<HandMadeTrial> second =
      trials({{"d", "a"}}, 1, 1) + trials({{"d", "b"}}, 0, 1) + trials({{"d", "c"}}, 0, 1);
  first[0].severity = 3;
  first[1].severity = 1;
  second[0].severity = 2;
  addHandMadeSession(store(), "p1", protocol, first);
  addHandMadeSession(store(), "p2", protocol, second);
  StudyChoice choice;
  choice.store = store();
  const StudyRates rates = studyRates(readStudyAnswers(choice));
  ASSERT_EQ(rates.scenarios.size(), 1U);
  const ScenarioSpread& spread = rates.scenarios[0];
  EXPECT_EQ(spread.presentation, "all");
  EXPECT_EQ(spread.rate.scenarios, 3U);
  EXPECT_DOUBLE_EQ(spread.rate.mean, 0.5);
  EXPECT_NEAR(spread.rate.sdOfN, std::sqrt(1.0 / 6.0), 1e-12);
  EXPECT_NEAR(*spread.rate.sd, 0.5, 1e-12);
  ASSERT_TRUE(spread.severity);
  EXPECT_EQ(spread.severity->scenarios, 2U);
  EXPECT_DOUBLE_EQ(spread.severity->mean, 1.75);
  EXPECT_DOUBLE_EQ(spread.severity->sdOfN, 0.75);
}

TEST_F(PublishedComparisonTest, SaysWhyOursIsMissing) {
  // One observer, one level of distance: no analysis of variance, no spread, no prediction.
  const std::string protocol =
      "task: {type: yes_no}\nfactors:\n  lod_change: [2_to_3, 3_to_9]\n  switch_distance: [4, 6]\n";
  addHandMadeSession(store(), "p1", protocol,
                     trials({{"lod_change", "2_to_3"}, {"switch_distance", "4"}}, 1, 4) +
                         trials({{"lod_change", "2_to_3"}, {"switch_distance", "4"}}, 0, 2, false));
  StudyChoice choice;
  choice.store = store();
  StudyAnswers study = readStudyAnswers(choice);
  study.plan.name = "experiment_1";
  const StudyRates rates = studyRates(study);
  const std::vector<PartAnova> anova = studyAnova(study);
  StudyFindings findings;
  findings.study = &study;
  findings.rates = &rates;
  findings.anova = &anova;
  findings.whyNotValidated = "no predictions";
  const PublishedComparison out = comparePublished(findings);
  // Two of the design, two rates, four effects, six correlations.
  EXPECT_EQ(out.statistics.size(), 14U);
  EXPECT_EQ(out.data, "people");
  EXPECT_TRUE(out.notes.empty());
  EXPECT_EQ(*statistic(out, "observers").values[0].ours, 1.0);
  EXPECT_EQ(*statistic(out, "trials of each observer").values[0].ours, 6.0);
  const ComparedStatistic& rate = statistic(out, "detection rate, trials with a change");
  EXPECT_DOUBLE_EQ(*rate.values[0].ours, 0.25);
  EXPECT_FALSE(rate.values[1].ours);
  EXPECT_EQ(rate.values[1].oursText, "-");
  EXPECT_EQ(rate.values[0].published, "67.71 %");
  const ComparedStatistic& effect = statistic(out, "variance by lod_change");
  EXPECT_FALSE(effect.values[0].ours);
  EXPECT_THAT(effect.note, HasSubstr("ours: "));
  EXPECT_THAT(statistic(out, "rating with detection rate, static").note, HasSubstr("no predictions"));
  const Result result = resultOf(std::vector<PublishedComparison>{out});
  const std::string csv = toCsv(result.sections), shown = toText(result);
  EXPECT_THAT(csv,
              HasSubstr("\nstatistics,experiment_1,people,main,variance by lod_change,F,98.926,98.926,-,,,"));
  for (const std::string& all : {csv, shown, toJson(result).dump()}) {
    EXPECT_EQ(all.find("nan"), std::string::npos);
    EXPECT_EQ(all.find("inf"), std::string::npos);
  }
}

TEST_F(PublishedComparisonTest, NothingIsComparedWhereNothingWasPublished) {
  addHandMadeSession(store(), "p1", "task: {type: yes_no}\nfactors:\n  d: [a]\n", trials({{"d", "a"}}, 1, 2));
  const PublishedComparison out = compare();
  EXPECT_TRUE(out.statistics.empty());
  ASSERT_EQ(out.notes.size(), 1U);
  EXPECT_THAT(out.notes[0], HasSubstr("experiment_1, experiment_2"));
}

}  // namespace
}  // namespace limen::analysis
