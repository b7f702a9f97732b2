// SPDX-License-Identifier: BSD-3-Clause
#include "study/observers/power.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>

#include "experiments/base/error.h"
#include "tests/study/observers/binomial.h"
#include "tests/study/observers/example.h"

namespace limen::study {
namespace {

double tQuantile(double confidence, int degrees) {
  return boost::math::quantile(boost::math::students_t(degrees), 0.5 + confidence / 2.0);
}

// Mean and variance over observers of p = 0.1 + 0.9 logistic(z), z normal around 0 with SD 0.8.
std::pair<double, double> momentsOfP() {
  double mean = 0.0, square = 0.0;
  constexpr double kStep = 0.01;
  for (double u = -8.0; u <= 8.0; u += kStep) {
    const double weight = std::exp(-0.5 * u * u) / std::sqrt(2.0 * std::numbers::pi) * kStep;
    const double p = 0.1 + 0.9 / (1.0 + std::exp(-0.8 * u));
    mean += weight * p;
    square += weight * p * p;
  }
  return {mean, square - mean * mean};
}

TEST(Power, AgreesWithTheClosedFormOfObserversAndBinomialAnswers) {
  const Protocol protocol =
      boxProtocol(kYesNo + "simulation: {detected: 0.5, guess: 0.1, between_observers: {strength_sd: 0.8}}");
  PowerRequest request;
  request.observers = {10, 20};
  request.repetitions = {2, 10};
  request.simulations = 200;
  request.width = 0.2;
  const PowerResult result = simulatePower(protocol, chooseObserver("ideal").behaviour, request);
  ASSERT_EQ(result.designs.size(), 4u);
  const auto [mean, between] = momentsOfP();
  for (const PowerDesign& design : result.designs) {
    const int n = design.observers, r = design.repetitions;
    // Variance of an observer's rate: between observers and of r answers, E[p (1 - p)] = m - m^2 - var.
    const double variance = between + (mean - mean * mean - between) / r;
    // c4(n) = E[s] / sigma of normal samples; rates are nearly so.
    const double c4 = std::sqrt(2.0 / (n - 1.0)) * boost::math::tgamma_ratio(n / 2.0, (n - 1.0) / 2.0);
    const double t = tQuantile(0.95, n - 1), width = 2.0 * t * std::sqrt(variance / n);
    ASSERT_EQ(design.cells.size(), 2u);
    for (const PowerCell& cell : design.cells) {
      // Five standard errors over 200 experiments.
      EXPECT_NEAR(cell.mean, mean, 5.0 * std::sqrt(variance / n / 200.0));
      EXPECT_NEAR(cell.sdBetween * cell.sdBetween, variance,
                  5.0 * variance * std::sqrt(2.0 / (n - 1.0) / 200.0));
      EXPECT_NEAR(cell.meanWidth, c4 * width, 5.0 * cell.meanWidthError + 0.01 * width);
      EXPECT_LE(cell.degenerate, 0.02);
      // width <= 0.2 means s^2 <= variance (0.2 / width)^2; normal where there are ten answers.
      if (r < 10) continue;
      const double reached =
          boost::math::cdf(boost::math::chi_squared(n - 1), (n - 1) * 0.04 / (width * width));
      EXPECT_NEAR(cell.reached, reached, 5.0 * std::sqrt(reached * (1.0 - reached) / 200.0) + 0.05);
    }
    EXPECT_EQ(design.reaches, design.cells[design.worst].reached >= 0.8);
  }
}

TEST(Power, TheSmallestDesignIsTheFirstThatReaches) {
  const Protocol protocol = boxProtocol(kYesNo + "simulation: {detected: 0.5, guess: 0.1}");
  PowerRequest request;
  request.observers = {30, 5, 15};
  request.repetitions = {4, 1};
  request.simulations = 60;
  request.width = 0.22;
  const PowerResult result = simulatePower(protocol, chooseObserver("ideal").behaviour, request);
  // p = 0.55 for all: widths 2 t sqrt(0.2475 / (n r)). 30 x 4: 0.185; 15 x 4: 0.281; 30 x 1: 0.372.
  ASSERT_TRUE(result.fewestObservers && result.fewestTrials);
  EXPECT_EQ(result.designs[*result.fewestObservers].observers, 30);
  EXPECT_EQ(result.designs[*result.fewestObservers].repetitions, 4);
  EXPECT_EQ(*result.fewestTrials, *result.fewestObservers);
}

TEST(Power, ObserversWhoAllAgreeDoNotCountAsCertainty) {
  const Protocol protocol = boxProtocol(kYesNo + "simulation: {detected: 1}");
  PowerRequest request;
  request.observers = {5, 40};
  request.repetitions = {1};
  request.simulations = 5;
  const PowerResult result = simulatePower(protocol, chooseObserver("ideal").behaviour, request);
  ASSERT_EQ(result.designs.size(), 2u);
  // Lower end of the exact interval of n of n: alpha/2 = P(n of n) = p^n.
  EXPECT_NEAR(result.designs[0].cells[0].meanWidth, 1.0 - std::pow(0.025, 1.0 / 5.0), 1e-12);
  EXPECT_FALSE(result.designs[0].reaches);
  EXPECT_TRUE(result.designs[1].reaches);
  EXPECT_EQ(result.designs[1].cells[0].degenerate, 1.0);
}

TEST(Power, ThresholdsOfStaircasesVaryAsTheirObserversDo) {
  const Protocol protocol = boxProtocol(R"(
task: {type: yes_no, question: "Seen?"}
stimulus:
  scene: {name: box, distance: = distance}
  levels: {before: 1, after: 0}
procedure:
  type: quest_plus
  model: normal
  stimulus: {name: distance, from: 10, to: 90, count: 41}
  parameters: {mean: {from: 10, to: 90, count: 81}, sd: 2, guess: 0.01, lapse: 0.01}
  stop: {trials: 60}
simulation:
  variable: distance
  sigmoid: normal
  threshold: 50
  width: 6.579414508 # 2 z(0.95) SD of 2
  guess: 0.01
  lapse: 0.01
  between_observers: {threshold_sd: 8}
)");
  PowerRequest request;
  request.observers = {8};
  request.repetitions = {1};
  request.simulations = 25;
  const PowerResult result = simulatePower(protocol, chooseObserver("lapsing").behaviour, request);
  ASSERT_EQ(result.designs.size(), 1u);
  ASSERT_EQ(result.designs[0].cells.size(), 1u);
  const PowerCell& cell = result.designs[0].cells[0];
  EXPECT_TRUE(cell.threshold);
  EXPECT_FALSE(result.designs[0].judged);
  // 60 trials leave an error far below 8: within five standard errors of the SD of 25 x 7 degrees of freedom.
  EXPECT_NEAR(cell.sdBetween, 8.0, 5.0 * 8.0 / std::sqrt(2.0 * 175.0) + 0.2);
  EXPECT_NEAR(cell.mean, 50.0, 5.0 * 8.0 / std::sqrt(200.0));
}

TEST(Power, BadRequestsAreRefused) {
  const Protocol protocol = boxProtocol(kYesNo + "simulation: {detected: 0.5}");
  const auto tryWith = [&](const std::function<void(PowerRequest&)>& change) {
    PowerRequest request;
    change(request);
    simulatePower(protocol, chooseObserver("ideal").behaviour, request);
  };
  EXPECT_THROW(tryWith([](PowerRequest& r) { r.observers = {1}; }), Error);
  EXPECT_THROW(tryWith([](PowerRequest& r) { r.repetitions = {}; }), Error);
  EXPECT_THROW(tryWith([](PowerRequest& r) { r.width = 0.0; }), Error);
  EXPECT_THROW(tryWith([](PowerRequest& r) { r.confidence = 1.0; }), Error);
  EXPECT_THROW(tryWith([](PowerRequest& r) { r.simulations = 1; }), Error);
}

}  // namespace
}  // namespace limen::study
