// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "analysis/statistics/repeated_measures_anova.h"
#include "tests/analysis/statistics/expect.h"

namespace limen::analysis {
namespace {

using ::testing::ElementsAre;

// Data and expected values: reference/anova.R.
RepeatedMeasures lodByDistance() {
  return {{{"lod", 2}, {"distance", 4}},
          6,
          {0.31, 0.42, 0.55, 0.71, 0.12, 0.28, 0.33, 0.62, 0.22, 0.47, 0.61, 0.66, 0.18, 0.19, 0.41, 0.49,
           0.45, 0.51, 0.49, 0.83, 0.25, 0.36, 0.52, 0.58, 0.18, 0.33, 0.58, 0.79, 0.05, 0.31, 0.29, 0.71,
           0.39, 0.36, 0.72, 0.91, 0.22, 0.24, 0.47, 0.55, 0.27, 0.49, 0.44, 0.64, 0.31, 0.22, 0.35, 0.67},
          false};
}

RepeatedMeasures farFromSpherical() {
  return {{{"level", 4}},
          8,
          {4.1, 5.0, 9.7, 3.2,  3.6, 4.9, 5.1, 8.8, 4.4, 5.2, 12.3, 6.1, 3.9, 4.4, 2.6, 7.7,
           4.0, 5.3, 8.1, 10.9, 4.6, 5.1, 3.3, 4.8, 3.7, 4.6, 10.2, 9.4, 4.2, 5.5, 6.6, 2.9},
          false};
}

TEST(RepeatedMeasuresAnova, EffectsAreThoseOfR) {
  const RepeatedMeasuresAnova a = analyseRepeatedMeasures(lodByDistance());
  ASSERT_EQ(a.effects.size(), 3u);
  expectRelative(a.subjectSumOfSquares, 0.0684354166666667, 1e-10);
  const struct {
    const char* name;
    double df, dfError, ss, error, f, p;
  } expected[] = {
      {"lod", 1, 5, 0.2715020833333334, 0.0253854166666667, 53.475995075913, 0.000749212399339005},
      {"distance", 3, 15, 1.263539583333332, 0.117572916666667, 53.7342960928502, 2.94718501449235e-08},
      {"lod x distance", 3, 15, 0.0054395833333333, 0.1045229166666667, 0.260210081521196,
       0.852914405199017}};
  const double all = 0.0684354166666667 + 0.0253854166666667 + 0.117572916666667 + 0.1045229166666667;
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(a.effects[i].name, expected[i].name);
    EXPECT_EQ(a.effects[i].df, expected[i].df);
    EXPECT_EQ(a.effects[i].dfError, expected[i].dfError);
    expectRelative(a.effects[i].sumOfSquares, expected[i].ss, 1e-9);
    expectRelative(a.effects[i].errorSumOfSquares, expected[i].error, 1e-9);
    expectRelative(*a.effects[i].f, expected[i].f, 1e-9);
    expectRelative(*a.effects[i].p, expected[i].p, 1e-9);
    expectRelative(*a.effects[i].partialEtaSquared, expected[i].ss / (expected[i].ss + expected[i].error),
                   1e-9);
    expectRelative(*a.effects[i].generalisedEtaSquared, expected[i].ss / (expected[i].ss + all), 1e-9);
  }
}

TEST(RepeatedMeasuresAnova, SphericityIsThatOfR) {
  const RepeatedMeasuresAnova a = analyseRepeatedMeasures(lodByDistance());
  EXPECT_FALSE(a.effects[0].sphericity);
  const Sphericity& distance = *a.effects[1].sphericity;
  expectRelative(*distance.mauchlyW, 0.695764188115942, 1e-9);
  expectRelative(*distance.mauchlyP, 0.931948312724777, 1e-9);
  expectRelative(distance.greenhouseGeisser, 0.848632712761009, 1e-9);
  EXPECT_EQ(distance.huynhFeldt, 1.0);
  expectRelative(distance.pGreenhouseGeisser, 2.86252499734416e-07, 1e-8);
  expectRelative(distance.pHuynhFeldt, 2.94718501449237e-08, 1e-8);
  const Sphericity& both = *a.effects[2].sphericity;
  expectRelative(*both.mauchlyW, 0.618649064049823, 1e-9);
  expectRelative(*both.mauchlyP, 0.881567370920539, 1e-9);
  expectRelative(both.pGreenhouseGeisser, 0.816412330590687, 1e-9);

  const RepeatedMeasuresAnova b = analyseRepeatedMeasures(farFromSpherical());
  const Sphericity& spread = *b.effects[0].sphericity;
  expectRelative(*b.effects[0].f, 3.3136006121232, 1e-9);
  expectRelative(*spread.mauchlyW, 0.0198030512238058, 1e-9);
  expectRelative(*spread.mauchlyP, 0.0005315830890925, 1e-8);
  expectRelative(spread.greenhouseGeisser, 0.615679221994515, 1e-9);
  expectRelative(spread.huynhFeldt, 0.826469675738921, 1e-9);
  expectRelative(spread.pGreenhouseGeisser, 0.0718282130832987, 1e-8);
  expectRelative(spread.pHuynhFeldt, 0.0518349930542468, 1e-8);
}

/// One factor of two levels whose F is `f`: differences of mean 1 and a spread that makes t^2 so.
RepeatedMeasures withF(double f, size_t subjects) {
  RepeatedMeasures data{{{"change", 2}}, subjects, {}, false};
  const auto n = static_cast<double>(subjects);
  // Differences 1 +- s, as many of each, have sd s sqrt(n / (n - 1)); F = n / sd^2.
  const double s = std::sqrt((n - 1.0) / f);
  for (size_t i = 0; i < subjects; ++i) {
    data.values.push_back(i % 2 == 0 ? 1.0 + s : 1.0 - s);
    data.values.push_back(0.0);
  }
  return data;
}

TEST(RepeatedMeasuresAnova, IntervalOfPartialEtaSquaredIsThatOfNoncentralF) {
  const AnovaEffect effect = analyseRepeatedMeasures(withF(5.337, 12)).effects[0];
  expectRelative(*effect.f, 5.337, 1e-10);
  EXPECT_NEAR(*effect.p, 0.0413, 5e-5);  // Schwarz 2009, section 10.4.2
  EXPECT_EQ(effect.partialEtaSquaredInterval->low, 0.0);
  expectRelative(effect.partialEtaSquaredInterval->high, 0.603476011801789, 1e-6);
}

TEST(RepeatedMeasuresAnova, VanishingErrorIsInfiniteAndVanishingEffectUndefined) {
  const RepeatedMeasures steps{{{"step", 3}}, 3, {0.1, 0.4, 0.7, 1.1, 1.4, 1.7, 3.1, 3.4, 3.7}, false};
  const AnovaEffect same = analyseRepeatedMeasures(steps).effects[0];
  EXPECT_TRUE(std::isinf(*same.f));
  EXPECT_EQ(*same.p, 0.0);
  EXPECT_EQ(*same.partialEtaSquared, 1.0);
  EXPECT_FALSE(same.partialEtaSquaredInterval);
  EXPECT_FALSE(same.note.empty());
  const AnovaEffect none =
      analyseRepeatedMeasures({{{"step", 2}}, 3, {0.1, 0.1, 0.3, 0.3, 0.2, 0.2}, false}).effects[0];
  EXPECT_FALSE(none.f || none.p);
  EXPECT_FALSE(none.note.empty());
}

TEST(RepeatedMeasuresAnova, FewSubjectsLeaveMauchlyOut) {
  RepeatedMeasures data = farFromSpherical();
  data.subjects = 3;
  data.values.resize(12);
  const Sphericity s = *analyseRepeatedMeasures(data).effects[0].sphericity;
  EXPECT_FALSE(s.mauchlyW || s.mauchlyP);
  EXPECT_GE(s.greenhouseGeisser, 1.0 / 3.0);
  EXPECT_LE(s.huynhFeldt, 1.0);
  data.subjects = 2;
  data.values.resize(8);
  const Sphericity two = *analyseRepeatedMeasures(data).effects[0].sphericity;
  // One degree of freedom: the covariance has rank one.
  EXPECT_NEAR(two.greenhouseGeisser, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(two.huynhFeldt, 1.0 / 3.0, 1e-12);
}

TEST(RepeatedMeasuresAnova, ThreeFactorsSplitAllVariation) {
  // Sums of squares of all effects, their errors and subjects add up to the total, whatever the data.
  RepeatedMeasures data{{{"a", 2}, {"b", 3}, {"c", 2}}, 4, {}, false};
  for (int i = 0; i < 48; ++i) data.values.push_back(std::sin(i * i * 0.37) + 0.01 * i);
  const RepeatedMeasuresAnova a = analyseRepeatedMeasures(data);
  std::vector<std::string> names;
  double sum = a.subjectSumOfSquares, total = 0.0;
  for (const AnovaEffect& effect : a.effects) {
    names.push_back(effect.name);
    sum += effect.sumOfSquares + effect.errorSumOfSquares;
  }
  for (const double value : data.values) total += (value - a.grandMean) * (value - a.grandMean);
  EXPECT_THAT(names, ElementsAre("a", "b", "c", "a x b", "a x c", "b x c", "a x b x c"));
  expectRelative(sum, total, 1e-12);
  // The middle factor by its definition: marginal means over subjects.
  double ss = 0.0;
  for (size_t level = 0; level < 3; ++level) {
    double mean = 0.0;
    for (size_t i = 0; i < 48; ++i)
      if (i / 2 % 3 == level) mean += data.values[i] / 16.0;
    ss += 16.0 * (mean - a.grandMean) * (mean - a.grandMean);
  }
  expectRelative(a.effects[1].sumOfSquares, ss, 1e-12);
}

TEST(RepeatedMeasuresAnova, DesignsThatCannotBeTestedAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expectError([] { analyseRepeatedMeasures({{{"a", 2}}, 1, {1.0, 2.0}, false}); }, "subjects");
  expectError(
      [] {
        analyseRepeatedMeasures({{{"a", 2}, {"b", 1}}, 2, {1.0, 2.0, 3.0, 4.0}, false});
      },
      "factors[1]");
  expectError([] { analyseRepeatedMeasures({{}, 2, {1.0, 2.0}, false}); }, "factor");
  expectError([] { analyseRepeatedMeasures({{{"a", 2}}, 2, {1.0, 2.0, 3.0}, false}); }, "values[3]");
  expectError([=] { analyseRepeatedMeasures({{{"a", 2}}, 2, {1.0, nan, 3.0, 1.0}, false}); }, "values[1]");
}

TEST(AverageCells, RepetitionsAreAveragedAndGapsNamed) {
  const std::vector<WithinFactor> factors = {{"lod", 2}, {"distance", 2}};
  std::vector<CellObservation> observations;
  for (size_t s = 0; s < 2; ++s)
    for (size_t i = 0; i < 2; ++i)
      for (size_t j = 0; j < 2; ++j)
        for (const double value : {0.0, 1.0})
          observations.push_back({s, {i, j}, value * static_cast<double>(i)});
  const RepeatedMeasures data = averageCells(factors, 2, observations);
  EXPECT_THAT(data.values, ElementsAre(0.0, 0.0, 0.5, 0.5, 0.0, 0.0, 0.5, 0.5));
  EXPECT_FALSE(data.unequalReplicates);
  observations.push_back({1, {1, 0}, 0.5});
  EXPECT_TRUE(averageCells(factors, 2, observations).unequalReplicates);
  std::erase_if(observations, [](const CellObservation& o) {
    return o.subject == 1 && o.levels[0] == 1 && o.levels[1] == 0;
  });
  expectError([&] { averageCells(factors, 2, observations); },
              "subject 1 has no observation at lod 1, distance 0");
  observations[3].levels = {0, 2};
  expectError([&] { averageCells(factors, 2, observations); }, "observations[3]");
}

TEST(AverageCells, WeightsSayHowOftenAValueCounts) {
  // Of subject 0 at level 0: 5 of 10 and 1 of 5 are 6 of 15.
  const std::vector<CellObservation> observations = {
      {0, {0}, 0.5, 10}, {0, {0}, 0.2, 5}, {0, {1}, 0.6, 15}, {1, {0}, 0.2, 15}, {1, {1}, 1.0, 15}};
  const RepeatedMeasures data = averageCells({{"lod", 2}}, 2, observations);
  EXPECT_NEAR(data.values[0], 0.4, 1e-15);
  EXPECT_FALSE(data.unequalReplicates);
  std::vector<CellObservation> none = observations;
  none[1].weight = 0.0;
  expectError([&] { averageCells({{"lod", 2}}, 2, none); }, "observations[1]");
}

TEST(LevelMeans, AverageOverTheOtherFactors) {
  const std::vector<std::vector<double>> means = levelMeans(lodByDistance(), 1);
  ASSERT_EQ(means.size(), 4u);
  ASSERT_EQ(means[0].size(), 6u);
  EXPECT_NEAR(means[0][0], (0.31 + 0.12) / 2.0, 1e-15);
  EXPECT_NEAR(means[3][5], (0.64 + 0.67) / 2.0, 1e-15);
  EXPECT_NEAR(levelMeans(lodByDistance(), 0)[1][0], (0.12 + 0.28 + 0.33 + 0.62) / 4.0, 1e-15);
  expectError([] { levelMeans(lodByDistance(), 2); }, "factor");
}

TEST(ComparePairs, AreThoseOfR) {
  const std::vector<PairedComparison> c = comparePairs(lodByDistance(), 1);
  ASSERT_EQ(c.size(), 6u);
  EXPECT_EQ(c[1].second, 2u);
  expectRelative(c[1].difference, -0.23416666666666666, 1e-10);
  expectRelative(c[1].t, -6.47218082785354731, 1e-9);
  expectRelative(c[1].p, 0.00131197019836125, 1e-9);
  expectRelative(c[1].interval.low, -0.32717157426354965, 1e-9);
  expectRelative(c[1].interval.high, -0.14116175906978368, 1e-9);
  expectRelative(c[1].pHolm, 0.005247880793445014, 1e-9);
  expectRelative(c[3].pHolm, 0.034212123177784021, 1e-9);
  expectError([] { comparePairs(lodByDistance(), 2); }, "factor");
}

TEST(ComparePairs, EqualDifferencesAreInfiniteAndNoneIsNone) {
  const RepeatedMeasures data{{{"a", 3}}, 2, {0.1, 0.4, 0.1, 0.2, 0.5, 0.2}, false};
  const std::vector<PairedComparison> c = comparePairs(data, 0);
  EXPECT_TRUE(std::isinf(c[0].t) && c[0].t < 0.0);
  EXPECT_EQ(c[0].p, 0.0);
  EXPECT_EQ(c[1].t, 0.0);
  EXPECT_EQ(c[1].p, 1.0);
  EXPECT_FALSE(c[1].standardisedDifference);
}

}  // namespace
}  // namespace limen::analysis
