// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "analysis/statistics/mixed_logistic.h"
#include "tests/analysis/statistics/expect.h"

namespace limen::analysis {
namespace {

constexpr double kIterated = 1e-4;

// Data and expected values: reference/mixed.R (lme4).
MixedLogisticData detections() {
  const int64_t k[] = {1, 3, 6, 9, 11, 0, 1, 2, 5, 7,  3, 5, 9, 11, 12, 1, 2, 7,  10, 12,
                       2, 6, 6, 8, 9,  0, 2, 5, 9, 12, 1, 1, 3, 4,  6,  4, 7, 10, 10, 12};
  const double x[] = {-1, -0.4, 0.2, 0.8, 1.4};
  MixedLogisticData data;
  data.columns = {"intercept", "x"};
  for (size_t i = 0; i < 40; ++i) {
    data.successes.push_back(k[i]);
    data.trials.push_back(12);
    data.groups.push_back(i / 5);
    data.design.insert(data.design.end(), {1.0, x[i % 5]});
  }
  return data;
}

MixedLogisticData answers() {
  const int64_t y[] = {1, 0, 1, 1, 0, 1, 1, 0, 0, 1, 0, 1, 1, 1, 0, 0, 0, 1,
                       0, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 0, 0, 1, 0, 0, 0, 1};
  const double v[] = {0.3, -1.2, 0.8,  1.5,  -0.6, 0.1,  2.2,  -0.4, 0.9, 1.1,  -0.7, 0.2,
                      0.5, 1.9,  -1.5, 0.6,  -0.2, 1.3,  -0.9, 0.4,  0.7, -0.3, 1.6,  -1.1,
                      0.2, 1.8,  0.5,  -0.8, 0.9,  -1.4, 0.1,  1.2,  0.0, -0.5, 0.3,  0.6};
  const double w[] = {0, 1, 0, 1, 1, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 0,
                      1, 0, 1, 0, 1, 0, 1, 1, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1};
  const size_t sizes[] = {5, 8, 7, 9, 7};
  MixedLogisticData data;
  data.columns = {"intercept", "v", "w"};
  for (size_t group = 0; group < 5; ++group)
    for (size_t i = 0; i < sizes[group]; ++i) data.groups.push_back(group);
  for (size_t i = 0; i < 36; ++i) {
    data.successes.push_back(y[i]);
    data.trials.push_back(1);
    data.design.insert(data.design.end(), {1.0, v[i], w[i]});
  }
  return data;
}

void expectEffect(const FixedEffect& effect, double estimate, double error) {
  expectRelative(effect.estimate, estimate, kIterated);
  expectRelative(effect.standardError, error, kIterated);
  expectRelative(effect.z, estimate / error, 2.0 * kIterated);
  expectRelative(effect.interval.high, estimate + 1.959963984540054 * error, 4.0 * kIterated);
}

TEST(MixedLogistic, RandomInterceptIsThatOfLme4) {
  const MixedLogistic m = fitMixedLogistic(detections());
  expectEffect(m.fixed[0], -0.4337321074, 0.3551473227);
  expectEffect(m.fixed[1], 1.7447667445, 0.1677070014);
  expectRelative(m.interceptDeviation, 0.9437188778, kIterated);
  expectRelative(m.logLikelihood, -67.9423012246, 1e-9);
  expectRelative(m.aic, 141.884602449, 1e-7);
  const double modes[] = {0.076183056, -1.331490755, 0.992583495,  0.256736144,
                          0.166422322, -0.104401452, -1.331490755, 1.281726563};
  for (size_t g = 0; g < 8; ++g) EXPECT_NEAR(m.groups[g].intercept, modes[g], 1e-3);
  EXPECT_FALSE(m.singular);
  EXPECT_FALSE(m.slopeDeviation);
}

TEST(MixedLogistic, RandomSlopeIsThatOfLme4) {
  MixedLogisticOptions options;
  options.random = RandomEffects::kInterceptAndSlope;
  const MixedLogistic m = fitMixedLogistic(detections(), options);
  expectEffect(m.fixed[0], -0.3915352074, 0.3428478782);
  expectEffect(m.fixed[1], 1.7909510620, 0.2335587029);
  expectRelative(m.interceptDeviation, 0.8945131684, kIterated);
  expectRelative(*m.slopeDeviation, 0.4299542886, kIterated);
  expectRelative(*m.correlation, 0.3347671481, kIterated);
  expectRelative(m.logLikelihood, -66.6942109319, 1e-7);
  EXPECT_NEAR(m.groups[4].slope, -0.428729833, 1e-3);
}

TEST(MixedLogistic, SingleAnswersAreThoseOfLme4) {
  const MixedLogistic m = fitMixedLogistic(answers());
  expectEffect(m.fixed[0], -0.3331302382, 1.169049721);
  expectEffect(m.fixed[1], 4.0767106458, 1.845779556);
  expectEffect(m.fixed[2], -1.6752240494, 1.630923302);
  expectRelative(m.interceptDeviation, 1.938032287, kIterated);
  expectRelative(m.logLikelihood, -11.9254378125, 1e-7);
}

TEST(MixedLogistic, SingularSlopeHasTheErrorsOfLme4AndSaysSo) {
  const int64_t k[] = {1, 1, 0, 0, 1, 3, 3, 3, 4, 3, 4, 4, 1, 2, 3, 2, 3, 4,
                       1, 1, 1, 0, 4, 3, 0, 0, 0, 1, 1, 1, 3, 4, 3, 3, 4, 4};
  MixedLogisticData data;
  data.columns = {"intercept", "x"};
  for (size_t i = 0; i < 36; ++i) {
    data.successes.push_back(k[i]);
    data.trials.push_back(4);
    data.groups.push_back(i / 6);
    data.design.insert(data.design.end(), {1.0, -1.0 + 0.4 * static_cast<double>(i % 6)});
  }
  MixedLogisticOptions options;
  options.random = RandomEffects::kInterceptAndSlope;
  const MixedLogistic m = fitMixedLogistic(data, options);
  EXPECT_TRUE(m.singular);
  EXPECT_FALSE(m.note.empty());
  expectEffect(m.fixed[0], 0.1520435861, 0.6970488054);
  expectEffect(m.fixed[1], 1.2542867105, 0.3510012312);
  expectRelative(*m.correlation, -1.0, 1e-6);
  expectRelative(m.logLikelihood, -43.0368613167, 1e-8);
}

TEST(MixedLogistic, UnitsOfAColumnOnlyScaleItsCoefficient) {
  MixedLogisticData metres = detections();
  for (size_t i = 0; i < 40; ++i) metres.design[2 * i + 1] *= 1e6;
  MixedLogisticOptions options;
  options.random = RandomEffects::kInterceptAndSlope;
  const MixedLogistic a = fitMixedLogistic(detections(), options), b = fitMixedLogistic(metres, options);
  expectRelative(b.fixed[1].estimate * 1e6, a.fixed[1].estimate, 1e-5);
  expectRelative(b.fixed[1].standardError * 1e6, a.fixed[1].standardError, 1e-5);
  expectRelative(*b.slopeDeviation * 1e6, *a.slopeDeviation, 1e-5);
  expectRelative(b.logLikelihood, a.logLikelihood, 1e-9);
}

TEST(MixedLogistic, GroupsThatDoNotDifferGiveThePlainRegressionAndSaySo) {
  // All groups answer alike, 30 of 100 at -1 and 60 of 100 at 1: the maximum has no spread, and the
  // coefficients are those of the two log odds. Their variances without spread: (1/np(1-p) of both) / 4, over
  // 4 groups.
  MixedLogisticData data;
  data.columns = {"intercept", "x"};
  for (size_t g = 0; g < 4; ++g)
    for (const double x : {-1.0, 1.0}) {
      data.groups.push_back(g);
      data.trials.push_back(100);
      data.successes.push_back(x < 0.0 ? 30 : 60);
      data.design.insert(data.design.end(), {1.0, x});
    }
  const MixedLogistic m = fitMixedLogistic(data);
  const double low = std::log(30.0 / 70.0), high = std::log(60.0 / 40.0);
  EXPECT_TRUE(m.singular);
  EXPECT_FALSE(m.note.empty());
  EXPECT_NEAR(m.interceptDeviation, 0.0, 1e-3);
  EXPECT_NEAR(m.fixed[0].estimate, 0.5 * (low + high), 1e-6);
  EXPECT_NEAR(m.fixed[1].estimate, 0.5 * (high - low), 1e-6);
  EXPECT_NEAR(m.fixed[1].standardError, 0.5 * std::sqrt((1.0 / 21.0 + 1.0 / 24.0) / 4.0), 1e-5);
}

TEST(MixedLogistic, SteepCurvesOverAWideRangeAreNotTakenForSeparatedOnes) {
  // All groups alike; answers at +-10 are certain whatever the slope, so that those at +-1 fix it at their
  // log odds.
  MixedLogisticData data;
  data.columns = {"intercept", "x"};
  const double x[] = {-10.0, -1.0, 0.0, 1.0, 10.0};
  const int64_t k[] = {0, 7, 500, 993, 1000};
  for (size_t i = 0; i < 20; ++i) {
    data.groups.push_back(i / 5);
    data.trials.push_back(1000);
    data.successes.push_back(k[i % 5]);
    data.design.insert(data.design.end(), {1.0, x[i % 5]});
  }
  const MixedLogistic m = fitMixedLogistic(data);
  EXPECT_NEAR(m.fixed[0].estimate, 0.0, 1e-8);
  expectRelative(m.fixed[1].estimate, std::log(993.0 / 7.0), 1e-8);
}

TEST(MixedLogistic, LargeCountsKeepTheirDigits) {
  MixedLogisticData data = detections();
  for (size_t i = 0; i < 40; ++i) {
    data.successes[i] = data.successes[i] * 80000 + 20000;
    data.trials[i] = 1000000;
  }
  // With a million trials a cell, groups' levels are known: the fit reproduces each group's share of
  // successes.
  const MixedLogistic m = fitMixedLogistic(data);
  for (size_t g = 0; g < 8; ++g) {
    double fitted = 0.0, observed = 0.0;
    for (size_t i = 5 * g; i < 5 * g + 5; ++i) {
      const double eta =
          m.fixed[0].estimate + m.fixed[1].estimate * data.design[2 * i + 1] + m.groups[g].intercept;
      fitted += 1.0 / (1.0 + std::exp(-eta));
      observed += static_cast<double>(data.successes[i]) / 1e6;
    }
    EXPECT_NEAR(fitted, observed, 1e-4);
  }
}

TEST(MixedLogistic, DataWithoutAMaximumAreRefused) {
  MixedLogisticData separated = answers();
  for (size_t i = 0; i < 36; ++i) separated.successes[i] = separated.design[3 * i + 1] > 0.25 ? 1 : 0;
  expectError([&] { fitMixedLogistic(separated); }, "separates");
  // Every group changes its answer once, at its own intensity: the steeper and the wider, the better.
  MixedLogisticData stepped;
  stepped.columns = {"intercept", "x"};
  const int64_t steps[6][5] = {{0, 0, 0, 0, 1}, {0, 0, 0, 0, 1}, {0, 0, 0, 0, 1},
                               {0, 0, 1, 1, 1}, {0, 0, 1, 1, 1}, {0, 0, 0, 1, 1}};
  for (size_t g = 0; g < 6; ++g)
    for (size_t i = 0; i < 5; ++i) {
      stepped.groups.push_back(g);
      stepped.trials.push_back(1);
      stepped.successes.push_back(steps[g][i]);
      stepped.design.insert(stepped.design.end(), {1.0, -1.0 + 0.5 * static_cast<double>(i)});
    }
  expectError([&] { fitMixedLogistic(stepped); }, "grows without bound");
  MixedLogisticData silent = detections();
  silent.successes.assign(40, 0);
  expectError([&] { fitMixedLogistic(silent); }, "separates");
  MixedLogisticData dependent = detections();
  for (size_t i = 0; i < 40; ++i) dependent.design[2 * i + 1] = 3.0;
  expectError([&] { fitMixedLogistic(dependent); }, "column 'x'");
  MixedLogisticData one = detections();
  one.groups.assign(40, 7);
  expectError([&] { fitMixedLogistic(one); }, "groups");
}

TEST(MixedLogistic, MalformedInputIsRefusedByIndex) {
  MixedLogisticData data = detections();
  data.successes[3] = 13;
  expectError([&] { fitMixedLogistic(data); }, "successes[3]");
  data = detections();
  data.design[9] = std::numeric_limits<double>::infinity();
  expectError([&] { fitMixedLogistic(data); }, "design[4][x]");
  data = detections();
  data.groups.pop_back();
  expectError([&] { fitMixedLogistic(data); }, "groups[39]");
  data = detections();
  data.design.pop_back();
  expectError([&] { fitMixedLogistic(data); }, "design[79]");
  MixedLogisticOptions options;
  options.random = RandomEffects::kInterceptAndSlope;
  options.slopeColumn = 2;
  expectError([&] { fitMixedLogistic(detections(), options); }, "slopeColumn");
}

}  // namespace
}  // namespace limen::analysis
