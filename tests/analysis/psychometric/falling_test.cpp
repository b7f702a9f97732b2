// SPDX-License-Identifier: BSD-3-Clause
// Functions that fall, and blocks without a stimulus.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/psychometric/intervals.h"
#include "analysis/psychometric/objective.h"
#include "experiments/base/error.h"
#include "perception/psychometrics/psychometric_function.h"
#include "perception/psychometrics/random.h"
#include "tests/analysis/psychometric/simulated_sets.h"

namespace limen::analysis {
namespace {

using psychometrics::PsychometricFunction;
using psychometrics::Sigmoid;
using psychometrics::SigmoidFamily;
using psychometrics::StimulusAxis;
using testing::HasSubstr;

constexpr size_t kThreshold = 0, kWidth = 1, kGuess = 2, kLapse = 3, kSlope = kFitParameters;

FitSettings yesNo() {
  FitSettings settings;
  settings.task = readFitTask("yesno", "");
  return settings;
}

/// Answers of a yes/no observer whose guesses are told by levels far below the threshold.
Condition answers() { return drawSet(coverageExperiment("yesno"), 3); }

Condition mirrored(Condition condition) {
  for (Block& block : condition.blocks) block.level = -block.level;
  return condition;
}

FitIntervals intervalsBy(const std::string& method, const std::vector<Condition>& data, const Fit& fit) {
  if (method == "profile") return profileIntervals(data, fit, 0.95);
  if (method == "laplace") return laplaceIntervals(data, fit, 0.95);
  if (method == "posterior") return posteriorIntervals(data, fit, 0.95);
  return bootstrapIntervals(data, fit, bootstrap(data, fit, {60, 4, true, 1}), method == "bca", 0.95);
}

// F(x) falling is F(-x) rising: the same numbers bit for bit, but for the sign of the threshold and the
// slope.
TEST(FallingFit, IsTheRisingFitOfMirroredData) {
  for (const char* sigmoid : {"normal", "gumbel"})
    for (const FitMethod fitMethod : {FitMethod::MaximumLikelihood, FitMethod::MaximumPosterior}) {
      FitSettings rising = yesNo();
      rising.sigmoid = psychometrics::sigmoidFamily(sigmoid);
      rising.method = fitMethod;
      FitSettings falling = rising;
      falling.falling = true;
      rising.range = {-2.0, 1.5};
      falling.range = {-1.5, 2.0};
      const std::vector<Condition> a = {answers()}, b = {mirrored(answers())};
      const Fit up = fitPsychometric(a, rising), down = fitPsychometric(b, falling);
      const ConditionFit &one = up.conditions[0], &other = down.conditions[0];
      EXPECT_EQ(one.values[kThreshold], -other.values[kThreshold]);
      for (const size_t i : {kWidth, kGuess, kLapse}) EXPECT_EQ(one.values[i], other.values[i]);
      EXPECT_EQ(one.slope, -other.slope);
      EXPECT_EQ(up.logLikelihood, down.logLikelihood);
      EXPECT_EQ(up.logPrior, down.logPrior);
      EXPECT_EQ(one.deviance, other.deviance);
      EXPECT_EQ(one.probability(rising, 0.3), other.probability(falling, -0.3));
      std::vector<std::string> methods = {"profile", "laplace", "bootstrap", "bca"};
      // The posterior always has the priors' bounds, whatever the fit; its grid of four dimensions takes
      // seconds.
      if (fitMethod == FitMethod::MaximumPosterior) methods.push_back("posterior");
      for (const std::string& method : methods) {
        const auto own = intervalsBy(method, a, up).conditions[0];
        const auto turned = intervalsBy(method, b, down).conditions[0];
        for (const size_t i : {kThreshold, kWidth, kGuess, kLapse, kSlope}) {
          ASSERT_EQ(own[i].has_value(), turned[i].has_value()) << method << i;
          if (!own[i]) continue;
          const double sign = i == kThreshold || i == kSlope ? -1.0 : 1.0;
          const double low = sign < 0 ? -own[i]->high : own[i]->low;
          const double high = sign < 0 ? -own[i]->low : own[i]->high;
          EXPECT_LT(turned[i]->low, turned[i]->high) << method << i;
          // Quantiles of the bootstrap round once more from the other end.
          EXPECT_NEAR(turned[i]->low, low, 1e-14 * std::abs(low)) << method << i;
          EXPECT_NEAR(turned[i]->high, high, 1e-14 * std::abs(high)) << method << i;
          EXPECT_EQ(turned[i]->lowOpen, sign < 0 ? own[i]->highOpen : own[i]->lowOpen) << method << i;
        }
      }
    }
}

// Powers of two have logarithms that differ in sign alone from those of their reciprocals.
TEST(FallingFit, OfALogarithmicAxisIsTheRisingFitOfReciprocals) {
  FitSettings settings = yesNo();
  settings.axis = StimulusAxis::Logarithmic;
  Condition up, down;
  const int correct[] = {2, 3, 11, 27, 36, 39};
  for (int i = 0; i < 6; ++i) {
    up.blocks.push_back({std::exp2(i - 2), correct[i], 40, 0.0});
    down.blocks.push_back({std::exp2(2 - i), correct[i], 40, 0.0});
  }
  const Fit rising = fitPsychometric({up}, settings);
  settings.falling = true;
  const Fit falling = fitPsychometric({down}, settings);
  const ConditionFit &one = rising.conditions[0], &other = falling.conditions[0];
  EXPECT_NEAR(one.values[kThreshold] * other.values[kThreshold], 1.0, 1e-14);
  for (const size_t i : {kWidth, kGuess, kLapse}) EXPECT_EQ(one.values[i], other.values[i]);
  EXPECT_EQ(rising.logLikelihood, falling.logLikelihood);
  const double t = other.values[kThreshold], step = 1e-5 * t;
  const double range = 1.0 - other.values[kGuess] - other.values[kLapse];
  const double difference =
      (other.probability(settings, t + step) - other.probability(settings, t - step)) / (2.0 * step * range);
  EXPECT_NEAR(other.slope, difference, 1e-8 * std::abs(difference));
  EXPECT_LT(other.slope, 0.0);
  for (const char* method : {"profile", "laplace", "bootstrap"}) {
    const auto own = intervalsBy(method, {down}, falling).conditions[0];
    for (const size_t i : {kThreshold, kSlope}) {
      if (!own[i]) continue;
      EXPECT_LT(own[i]->low, i == kSlope ? other.slope : t) << method;
      EXPECT_GT(own[i]->high, i == kSlope ? other.slope : t) << method;
    }
  }
}

// A million answers a level of an observer who sees 1 - F of a Gumbel: of the mirrored axis that is the
// reversed one, with the same F at its threshold.
TEST(FallingFit, RecoversAnObserverWhoSeesLessOfMore) {
  const double level = 0.6, threshold = 0.4, width = 1.5, guess = 0.04, lapse = 0.02;
  const Sigmoid rising =
      Sigmoid::fromThresholdWidth(SigmoidFamily::Gumbel, StimulusAxis::Linear, threshold, width, 1.0 - level);
  Condition condition;
  for (int i = 0; i <= 10; ++i) {
    const double x = -1.6 + 0.4 * i;
    const double p = guess + (1.0 - guess - lapse) * rising.complement(x);
    condition.blocks.push_back({x, std::llround(1e6 * p), 1000000, 0.0});
  }
  FitSettings settings = yesNo();
  settings.sigmoid = SigmoidFamily::ReversedGumbel;
  settings.thresholdLevel = level;
  settings.falling = true;
  const ConditionFit fit = fitPsychometric({condition}, settings).conditions[0];
  EXPECT_NEAR(fit.values[kThreshold], threshold, 1e-5);
  EXPECT_NEAR(fit.values[kWidth], width, 1e-5);
  EXPECT_NEAR(fit.values[kGuess], guess, 1e-5);
  EXPECT_NEAR(fit.values[kLapse], lapse, 1e-5);
  EXPECT_LT(fit.deviance, 1e-3);
}

TEST(FallingFit, DirectionIsThatOfTheAnswers) {
  const FitSettings settings = yesNo();
  EXPECT_FALSE(answersFall({answers()}, settings));
  EXPECT_TRUE(answersFall({mirrored(answers())}, settings));
  // Conditions that differ say nothing, trials without a stimulus neither.
  const Condition low = {"a", {{0.0, 1, 20, 0.0}, {1.0, 2, 20, 0.0}}},
                  high = {"b", {{-1.0, 17, 20, 0.0}, {-0.5, 18, 20, 0.0}, {kNoStimulus, 19, 20, 0.0}}};
  EXPECT_FALSE(answersFall({low, high}, settings));
  FitSettings wrong = settings;
  wrong.falling = true;
  const Fit fit = fitPsychometric({answers()}, wrong);
  EXPECT_THAT(fit.conditions[0].warnings, testing::Contains(HasSubstr("better with the level")));
}

// P = guess where nothing is shown: the likelihood has the factor of a binomial with that rate, and nothing
// else changes.
TEST(NoStimulus, MultipliesTheLikelihoodByThatOfGuesses) {
  for (const bool falling : {false, true})
    for (const StimulusAxis axis : {StimulusAxis::Linear, StimulusAxis::Logarithmic}) {
      FitSettings settings = yesNo();
      settings.falling = falling;
      settings.axis = axis;
      Condition plain = falling ? mirrored(answers()) : answers();
      if (axis == StimulusAxis::Logarithmic)
        for (Block& block : plain.blocks) block.level = std::exp(block.level);
      Condition with = plain;
      const double k = 7, n = 50;
      with.blocks.push_back({kNoStimulus, 7, 50, 0.0});
      const Fit fit = fitPsychometric({with}, settings);
      const auto logLikelihood = [&](const std::array<double, kFitParameters>& values) {
        ConditionFit at = fit.conditions[0];
        at.values = values;
        const double guess = values[kGuess];
        double sum = std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1) + k * std::log(guess) +
                     (n - k) * std::log1p(-guess);
        for (const Block& block : plain.blocks) {
          const double p = at.probability(settings, block.level), own = static_cast<double>(block.correct),
                       all = static_cast<double>(block.trials);
          sum += std::lgamma(all + 1) - std::lgamma(own + 1) - std::lgamma(all - own + 1) +
                 (own > 0 ? own * std::log(p) : 0.0) + (own < all ? (all - own) * std::log1p(-p) : 0.0);
        }
        return sum;
      };
      const std::array<double, kFitParameters>& best = fit.conditions[0].values;
      EXPECT_NEAR(fit.logLikelihood, logLikelihood(best), 1e-9);
      for (const size_t i : {kThreshold, kWidth, kGuess, kLapse})
        for (const double step : {-1e-4, 1e-4}) {
          auto near = best;
          near[i] += step;
          if (near[i] <= 0.0 && i != kThreshold) continue;
          EXPECT_LT(logLikelihood(near), fit.logLikelihood + 1e-12) << i;
        }
      EXPECT_NE(best[kGuess], fitPsychometric({plain}, settings).conditions[0].values[kGuess]);
      EXPECT_EQ(fit.conditions[0].probability(settings, kNoStimulus), best[kGuess]);
    }
}

TEST(NoStimulus, EndlessTrialsHoldTheGuessRate) {
  FitSettings settings = yesNo(), held = settings;
  held.fixed[kGuess] = 0.07;
  Condition with = answers();
  with.blocks.push_back({kNoStimulus, 70000000, 1000000000, 0.0});
  const ConditionFit free = fitPsychometric({with}, settings).conditions[0],
                     fixed = fitPsychometric({answers()}, held).conditions[0];
  for (const size_t i : {kThreshold, kWidth, kGuess, kLapse})
    EXPECT_NEAR(free.values[i], fixed.values[i], 1e-5) << i;
}

// With the guess rate known they tell nothing, and bounds, priors and starts go by the levels alone.
TEST(NoStimulus, ChangesNothingWhereTheGuessRateIsKnown) {
  Condition with = answers();
  with.blocks.insert(with.blocks.begin(), {kNoStimulus, 3, 50, 0.0});
  for (const FitMethod method : {FitMethod::MaximumLikelihood, FitMethod::MaximumPosterior}) {
    FitSettings settings = yesNo();
    settings.fixed[kGuess] = 0.05;
    settings.method = method;
    const Objective own({answers()}, settings), more({with}, settings);
    for (size_t j = 0; j < own.size(); ++j) {
      EXPECT_EQ(own.free()[j].low, more.free()[j].low);
      EXPECT_EQ(own.free()[j].high, more.free()[j].high);
      EXPECT_EQ(own.free()[j].spread.spacing, more.free()[j].spread.spacing);
    }
    const std::vector<Condition> a = {answers()}, b = {with};
    const Fit one = fitPsychometric(a, settings), other = fitPsychometric(b, settings);
    for (const size_t i : {kThreshold, kWidth, kLapse})
      EXPECT_NEAR(one.conditions[0].values[i], other.conditions[0].values[i], 1e-7) << i;
    for (const char* intervals : {"profile", "posterior"}) {
      const auto x = intervalsBy(intervals, a, one).conditions[0],
                 y = intervalsBy(intervals, b, other).conditions[0];
      EXPECT_NEAR(x[kThreshold]->low, y[kThreshold]->low, 1e-6) << intervals;
      EXPECT_NEAR(x[kThreshold]->high, y[kThreshold]->high, 1e-6) << intervals;
    }
  }
}

TEST(NoStimulus, RefusesWhatHasNoAnswer) {
  const auto message = [](const Condition& condition, const FitSettings& settings) -> std::string {
    try {
      fitPsychometric({condition}, settings, "data.csv");
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  FitSettings settings = yesNo();
  EXPECT_THAT(message({"", {{kNoStimulus, 1, 9, 0.0}}}, settings), HasSubstr("without a stimulus"));
  EXPECT_THAT(message({"", {{kNoStimulus, 1, 9, 0.0}, {1.0, 5, 9, 0.0}}}, settings), HasSubstr("one level"));
  EXPECT_THAT(message({"", {{-kNoStimulus, 1, 9, 0.0}, {1.0, 5, 9, 0.0}}}, settings),
              HasSubstr("not a finite"));
  settings.falling = true;
  settings.axis = StimulusAxis::Logarithmic;
  EXPECT_THAT(message({"", {{0.0, 5, 9, 0.0}, {1.0, 4, 9, 0.0}, {2.0, 1, 9, 0.0}}}, settings),
              HasSubstr("falling logarithmic axis"));
  settings.fixed[kGuess] = 0.0;
  EXPECT_THAT(message({"", {{kNoStimulus, 1, 9, 0.0}, {1.0, 4, 9, 0.0}, {2.0, 1, 9, 0.0}}}, settings),
              HasSubstr("no parameters"));
}

}  // namespace
}  // namespace limen::analysis
