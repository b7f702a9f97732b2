// SPDX-License-Identifier: BSD-3-Clause
// The choice among candidates from given errors and times, and the estimate of errors from noisy references.
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "renderer/techniques/scene_needs/needs_record.h"

namespace limen::techniques {
namespace {

using testing::ElementsAre;

/// With an exactly known error; times spread by `spread` either way.
Tried withFigures(double ms, double rmse, double spread = 0.0) {
  Tried out;
  out.error.meanSquare = rmse * rmse;
  out.error.pixels = 1000;
  out.time = {ms, ms - spread, ms + spread, 9};
  return out;
}

TEST(SceneNeedsDecision, TheCheapestWithinTheTargetIsChosen) {
  const std::vector<Tried> tried = {withFigures(1.0, 0.05), withFigures(3.0, 0.01), withFigures(2.0, 0.02),
                                    withFigures(9.0, 0.001)};
  const Verdict verdict = decide(tried, 0.03);
  EXPECT_EQ(verdict.chosen, 2U);
  EXPECT_TRUE(verdict.withinTarget);
  EXPECT_THAT(verdict.eligible, ElementsAre(1, 2, 3));
}

TEST(SceneNeedsDecision, WithoutOneWithinTheTargetItIsTheMostExact) {
  const std::vector<Tried> tried = {withFigures(1.0, 0.05), withFigures(3.0, 0.01), withFigures(2.0, 0.02)};
  const Verdict verdict = decide(tried, 0.005);
  EXPECT_EQ(verdict.chosen, 1U);
  EXPECT_FALSE(verdict.withinTarget);
}

TEST(SceneNeedsDecision, TimesWithinTheirSpreadAreEqual) {
  // 1.0 to 1.1 and 0.95 to 1.05 overlap, so that the smaller error decides; 2 ms does not.
  const std::vector<Tried> tried = {withFigures(1.0, 0.02, 0.05), withFigures(1.05, 0.01, 0.05),
                                    withFigures(2.0, 0.001, 0.05)};
  EXPECT_EQ(decide(tried, 0.03).chosen, 1U);
}

TEST(SceneNeedsDecision, ErrorsWithinTheReferencesNoiseAreEqual) {
  // Neither is within the target. Noise of 1e-5 in a mean square of 1e-4 is one of 4.5e-4 in the RMSE of
  // 0.01: sqrt(1.2e-4) - 0.01 = 9.5e-4 at two standard errors.
  std::vector<Tried> tried = {withFigures(5.0, 0.01), withFigures(1.0, 0.0105), withFigures(0.5, 0.012)};
  EXPECT_EQ(decide(tried, 0.001).chosen, 0U);
  for (Tried& one : tried) one.error.samplingNoise = 1e-5;
  EXPECT_EQ(decide(tried, 0.001).chosen, 1U);
}

TEST(SceneNeedsDecision, TheChoiceOfPixelsMustNotBringAnErrorBelowTheTarget) {
  // A standard error of 10 % of the mean square: the upper limit of the RMSE is sqrt(1.2) times the estimate.
  std::vector<Tried> tried = {withFigures(1.0, 0.0195), withFigures(2.0, 0.018)};
  EXPECT_EQ(decide(tried, 0.02).chosen, 0U);
  for (Tried& one : tried) one.error.standardError = 0.1 * one.error.meanSquare;
  EXPECT_NEAR(margin(tried), std::sqrt(1.2) - 1.0, 1e-12);
  const Verdict verdict = decide(tried, 0.02);
  EXPECT_EQ(verdict.chosen, 1U);
  EXPECT_TRUE(verdict.withinTarget);
}

TEST(SceneNeedsDecision, NoOtherCandidateIsBothFasterAndMoreExact) {
  std::mt19937 random(7);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int round = 0; round < 2000; ++round) {
    std::vector<Tried> tried;
    for (int i = 0; i < 12; ++i) {
      tried.push_back(withFigures(uniform(0.5, 3.0), uniform(0.0, 0.05), uniform(0.0, 0.5)));
      tried.back().error.samplingNoise = uniform(0.0, 1e-4);
      tried.back().error.standardError = uniform(0.0, 2e-4);
    }
    const double target = uniform(0.0, 0.05);
    const Verdict verdict = decide(tried, target);
    const Tried& chosen = tried[verdict.chosen];
    for (const Tried& other : tried)
      ASSERT_FALSE(other.time.medianMs < chosen.time.medianMs &&
                   other.error.meanSquare < chosen.error.meanSquare)
          << "round " << round;
    ASSERT_TRUE(!verdict.withinTarget || chosen.error.value() <= target) << "round " << round;
  }
}

TEST(SceneNeedsDecision, TheFrontHoldsWhatNothingBeats) {
  const std::vector<Tried> tried = {withFigures(3.0, 0.01), withFigures(1.0, 0.05), withFigures(2.0, 0.06),
                                    withFigures(4.0, 0.01), withFigures(2.5, 0.02)};
  EXPECT_THAT(front(tried), ElementsAre(1, 4, 0));
}

TEST(SceneNeedsDecision, TimesAreMediansAndQuartiles) {
  const TimeEstimate time = estimateTime({5.0, 1.0, 2.0, 4.0, 3.0});
  EXPECT_EQ(time.medianMs, 3.0);
  EXPECT_EQ(time.lowMs, 2.0);
  EXPECT_EQ(time.highMs, 4.0);
  EXPECT_EQ(time.frames, 5);
  EXPECT_EQ(estimateTime({2.0}).medianMs, 2.0);
}

TEST(SceneNeedsRecord, SaysWhatFullSizeMadeOfTheChoice) {
  SceneNeedsFound found;
  found.tried = {withFigures(1.0, 0.05), withFigures(2.0, 0.01), withFigures(3.0, 0.03)};
  for (Tried& one : found.tried) one.candidate.technique = "soft_shadows/hard";
  found.notTried = {"soft_shadows/pcf: no reason"};
  found.verdict = decide(found.tried, 0.02);
  found.times = "hours";
  found.check.time = {2.5, 2.4, 2.6, 9};
  const auto counter = [&](const std::string& name) {
    for (const Counter& one : countersOf(found))
      if (one.name == name) return one.value;
    return -1.0;
  };
  found.check.error.meanSquare = 0.015 * 0.015;
  EXPECT_THAT(remarksOn(found), testing::Contains(testing::HasSubstr("the target is met")));
  EXPECT_EQ(counter("target_met"), 1.0);
  EXPECT_EQ(counter("candidates_within_target"), 1.0);
  EXPECT_EQ(counter("check_ms"), 2.5);
  EXPECT_DOUBLE_EQ(counter("expected_rmse"), 0.01);
  found.check.error.meanSquare = 0.025 * 0.025;
  const std::vector<std::string> remarks = remarksOn(found);
  EXPECT_THAT(remarks, testing::Contains(testing::HasSubstr("the target is missed")));
  EXPECT_THAT(remarks, testing::Contains("not beaten in time and RMSE: 2 ms, 0.01: hard"));
  EXPECT_THAT(remarks,
              testing::Contains("beaten, as another is no worse in time and RMSE: 3 ms, 0.03: hard"));
  EXPECT_THAT(remarks, testing::Contains("not tried: soft_shadows/pcf: no reason"));
  EXPECT_EQ(counter("target_met"), 0.0);
  // What the record counts is declared.
  std::vector<std::string> declared;
  for (const Quantity& one : needsQuantities()) declared.push_back(one.name);
  for (const Counter& one : countersOf(found)) EXPECT_THAT(declared, testing::Contains(one.name));

  found.target = RmseTarget{0.001};
  found.verdict = decide(found.tried, 0.001);
  EXPECT_THAT(remarksOn(found), testing::Contains(testing::HasSubstr("the most exact one was chosen")));
  EXPECT_EQ(counter("candidates_within_target"), 0.0);
}

TEST(SceneNeedsRecord, SaysWhichDisplayJndAreFor) {
  SceneNeedsFound found;
  found.target = JndTarget{.value = 1.0};
  // Errors are the squares of what is limited.
  found.tried = {withFigures(1.0, 1.5), withFigures(2.0, 0.5)};
  for (Tried& one : found.tried) one.candidate.technique = "soft_shadows/hard";
  found.verdict = decide(found.tried, 1.0);
  found.check.error.meanSquare = 0.6 * 0.6;
  const std::vector<std::string> remarks = remarksOn(found);
  EXPECT_THAT(remarks,
              testing::Contains("1 of 2 candidates stay within the target, p95 of JND on desktop_24 1: "
                                "the cheapest of them was chosen"));
  EXPECT_THAT(remarks, testing::Contains("not beaten in time and p95 of JND on desktop_24: 2 ms, 0.5: hard"));
  std::vector<std::string> declared;
  for (const Quantity& one : needsQuantities()) declared.push_back(one.name);
  for (const Counter& one : countersOf(found)) {
    EXPECT_THAT(declared, testing::Contains(one.name));
    EXPECT_THAT(one.name, testing::Not(testing::HasSubstr("rmse")));
  }
}

class SceneNeedsErrors : public testing::Test {
 protected:
  static constexpr int kSide = 64;

  /// References of a visibility of 1/2 everywhere, each the mean of `samples` rays that hit or miss.
  ReferencePair references(int samples) {
    ReferencePair out{Image(kSide, kSide, 1), Image(kSide, kSide, 1), Image(kSide, kSide, 1, 1.0F)};
    std::binomial_distribution<int> hits(samples, 0.5);
    for (Image* image : {&out.first, &out.second})
      for (float& value : image->data)
        value = static_cast<float>(hits(random_)) / static_cast<float>(samples);
    return out;
  }

  std::mt19937 random_{11};
};

TEST_F(SceneNeedsErrors, TheReferencesNoiseIsRemoved) {
  // 16 rays have a variance of 1/64, their noise an RMS of 0.125, and the mean of two references one of
  // 0.125 / sqrt(2) = 0.088: more than the errors that are to be found.
  for (const double error : {0.0, 0.02, 0.05}) {
    const Image product(kSide, kSide, 1, static_cast<float>(0.5 + error));
    double sum = 0.0, squares = 0.0, stated = 0.0;
    constexpr int kRounds = 200;
    for (int round = 0; round < kRounds; ++round) {
      const ReferencePair truth = references(16);
      const ErrorEstimate estimate = estimateError(product, truth);
      // 4,096 pixels' mean: the RMS is known to a hundredth.
      EXPECT_NEAR(truth.noise(), 0.125 / std::sqrt(2.0), 0.006);
      EXPECT_EQ(estimate.pixels, kSide * kSide);
      sum += estimate.meanSquare;
      squares += std::pow(estimate.meanSquare - error * error, 2.0);
      stated += estimate.samplingNoise;
    }
    const double noise = std::sqrt(squares / kRounds);
    // No bias: the mean over 200 rounds deviates by no more than four of its own standard errors.
    EXPECT_NEAR(sum / kRounds, error * error, 4.0 * noise / std::sqrt(double(kRounds))) << error;
    // What is stated is that noise or, by up to the square root of 3 where noise is all there is (E[d^4] of a
    // normal d is 3 times E[d^2]^2) and in general by 2 at most, more. A standard deviation of 200 values is
    // known to 5 %.
    EXPECT_GE(stated / kRounds, 0.85 * noise) << error;
    EXPECT_LE(stated / kRounds, 2.0 * 1.15 * noise) << error;
  }
}

TEST_F(SceneNeedsErrors, OnlySurfacesCount) {
  ReferencePair truth{Image(2, 1, 1, 1.0F), Image(2, 1, 1, 1.0F), Image(2, 1, 1, 1.0F)};
  truth.mask.at(1, 0) = 0.0F;
  Image product(2, 1, 1, 0.75F);
  product.at(1, 0) = 0.0F;
  EXPECT_DOUBLE_EQ(estimateError(product, truth).value(), 0.25);
  EXPECT_EQ(errorMap(product, truth).at(0, 0), 0.25F);
  EXPECT_EQ(errorMap(product, truth).at(1, 0), 0.0F);
}

TEST_F(SceneNeedsErrors, WhatIsNotFiniteIsWrongByTheWholeRange) {
  const ReferencePair truth{Image(2, 1, 1, 1.0F), Image(2, 1, 1, 1.0F), Image(2, 1, 1, 1.0F)};
  Image product(2, 1, 1, 1.0F);
  product.at(0, 0) = NAN;
  EXPECT_DOUBLE_EQ(estimateError(product, truth).meanSquare, 0.5);
}

TEST_F(SceneNeedsErrors, LimitsHoldTheErrorOfAllPixels) {
  // Errors of 0.1 in one pixel of ten: a mean square of 1e-3. Small pictures of 400 of them miss it by more
  // than two standard errors in 5 % of the cases, or somewhat more as their number is far from normal.
  const ReferencePair truth{Image(20, 20, 1, 1.0F), Image(20, 20, 1, 1.0F), Image(20, 20, 1, 1.0F)};
  std::bernoulli_distribution wrong(0.1);
  int held = 0;
  for (int round = 0; round < 500; ++round) {
    Image product(20, 20, 1, 1.0F);
    for (float& value : product.data) value = wrong(random_) ? 0.9F : 1.0F;
    const ErrorEstimate estimate = estimateError(product, truth);
    held += estimate.low() <= std::sqrt(1e-3) && std::sqrt(1e-3) <= estimate.high();
  }
  EXPECT_GT(held, 0.9 * 500);
}

}  // namespace
}  // namespace limen::techniques
