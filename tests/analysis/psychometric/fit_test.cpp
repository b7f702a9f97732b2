// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/psychometric/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analysis/psychometric/objective.h"
#include "analysis/psychometric/optimiser.h"
#include "experiments/base/error.h"
#include "perception/psychometrics/psychometric_function.h"
#include "perception/psychometrics/random.h"
#include "tests/analysis/psychometric/simulated_sets.h"

namespace limen::analysis {
namespace {

using psychometrics::PsychometricFunction;
using psychometrics::Random;
using psychometrics::Sigmoid;
using psychometrics::SigmoidFamily;
using psychometrics::StimulusAxis;
using testing::HasSubstr;

double threshold(const Fit& fit, size_t c = 0) { return fit.conditions[c].value(FitParameter::Threshold); }
double width(const Fit& fit, size_t c = 0) { return fit.conditions[c].value(FitParameter::Width); }
double lapse(const Fit& fit, size_t c = 0) { return fit.conditions[c].value(FitParameter::Lapse); }
bool warns(const Fit& fit, const std::string& words) {
  for (const std::string& warning : fit.conditions[0].warnings)
    if (warning.find(words) != std::string::npos) return true;
  return false;
}

double logChoose(double n, double k) {
  return std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1);
}

/// ln likelihood written out, from psychometrics' functions.
double plainLogLikelihood(const Condition& condition, const FitSettings& settings, const ConditionFit& fit) {
  const PsychometricFunction function(fit.sigmoid(settings), fit.value(FitParameter::Guess),
                                      fit.value(FitParameter::Lapse));
  double sum = 0.0;
  for (const Block& block : condition.blocks) {
    const double k = static_cast<double>(block.correct), n = static_cast<double>(block.trials);
    sum += logChoose(n, k) + (k > 0 ? k * function.logProbability(block.level) : 0.0) +
           (k < n ? (n - k) * function.logComplement(block.level) : 0.0);
  }
  return sum;
}

// psignifit 4's example. Published to the precision of its search: 0.0046478171, 0.0046590718, 5.9328130.
// Newton's method on the written-out score equations (lapse rate at 0) ends at 4.64781701986168e-3
// and 4.65907199366150e-3.
TEST(PsychometricFit, FindsThePublishedMaximumOfTheClassicSet) {
  const Fit fit = fitPsychometric({classicSet()}, FitSettings{});
  EXPECT_NEAR(threshold(fit), 0.0046478171, 2e-10);
  EXPECT_NEAR(width(fit), 0.0046590718, 2e-10);
  EXPECT_NEAR(fit.deviance, 5.9328130, 5e-8);
  EXPECT_NEAR(threshold(fit), 4.64781701986168e-3, 1e-13);
  EXPECT_NEAR(width(fit), 4.65907199366150e-3, 1e-13);
  EXPECT_EQ(lapse(fit), 0.0);
  EXPECT_EQ(fit.conditions[0].atBound[indexOf(FitParameter::Lapse)], -1);
  EXPECT_NEAR(fit.logLikelihood, plainLogLikelihood(classicSet(), FitSettings{}, fit.conditions[0]), 1e-9);
  EXPECT_NEAR(fit.aic, 6.0 - 2.0 * fit.logLikelihood, 1e-12);
  EXPECT_NEAR(fit.bic, 3.0 * std::log(1170.0) - 2.0 * fit.logLikelihood, 1e-12);
}

/// A set of answers to `settings.task` from an observer drawn at random.
Condition randomSet(const FitSettings& settings, Random& random) {
  const bool logarithmic = settings.logarithmic();
  const double u = random.uniform(-0.5, 0.5), w = std::exp(random.uniform(-2.0, 1.5));
  const Sigmoid sigmoid =
      Sigmoid::fromThresholdWidth(settings.sigmoid, settings.axis, logarithmic ? std::exp(u) : u, w);
  const double rate = random.uniform(0.0, 0.08);
  const double guess = settings.task.kind == FitTask::Kind::ForcedChoice ? 1.0 / settings.task.alternatives
                       : settings.task.kind == FitTask::Kind::EqualAsymptotes ? rate
                                                                              : random.uniform(0.0, 0.2);
  const PsychometricFunction observer(sigmoid, guess, rate);
  const int levels = 4 + static_cast<int>(random.below(6)), trials = 5 + static_cast<int>(random.below(60));
  Condition condition;
  for (int i = 0; i < levels; ++i) {
    const double at = -1.0 + 2.0 * i / (levels - 1), x = logarithmic ? std::exp(at) : at;
    condition.blocks.push_back({x, random.binomial(trials, observer.probability(x)), trials, 0.0});
  }
  return condition;
}

std::vector<double> randomStart(const Objective& objective, Random& random) {
  std::vector<double> x;
  for (const FreeParameter& free : objective.free()) x.push_back(random.uniform(free.low, free.high));
  return x;
}

const char* const kTasks[] = {"yesno", "2afc", "mafc:4", "equal"};

TEST(PsychometricFit, FiftyRandomRestartsNeverImproveTheOptimum) {
  for (const std::string& name : psychometrics::sigmoidNames()) {
    for (const char* task : kTasks) {
      for (const int variant : {0, 1, 2}) {
        FitSettings settings;
        settings.sigmoid = psychometrics::sigmoidFamily(name);
        settings.task = readFitTask(task, "");
        if (variant == 1) settings.method = FitMethod::MaximumPosterior;
        settings.overdispersion = variant == 2;
        Random random(psychometrics::childSeed(11, name + task + std::to_string(variant)));
        const Condition condition = randomSet(settings, random);
        const Fit fit = fitPsychometric({condition}, settings);
        const Objective objective({condition}, settings);
        const double least = objective.evaluate(fit.x.data(), nullptr);
        for (int restart = 0; restart < 50; ++restart) {
          const Optimum other = minimise(objective, randomStart(objective, random));
          ASSERT_GE(other.value, least - 1e-6) << name << " " << task << " variant " << variant;
        }
      }
    }
  }
}

TEST(PsychometricFit, FiftyRandomRestartsNeverImproveASharedDesign) {
  for (const char* task : kTasks) {
    FitSettings settings;
    settings.task = readFitTask(task, "");
    settings.shared[indexOf(FitParameter::Width)] = settings.shared[indexOf(FitParameter::Lapse)] = true;
    Random random(psychometrics::childSeed(12, task));
    const std::vector<Condition> conditions = {randomSet(settings, random), randomSet(settings, random),
                                               randomSet(settings, random)};
    const Fit fit = fitPsychometric(conditions, settings);
    EXPECT_EQ(width(fit, 0), width(fit, 2));
    EXPECT_EQ(lapse(fit, 0), lapse(fit, 1));
    const Objective objective(conditions, settings);
    const double least = objective.evaluate(fit.x.data(), nullptr);
    for (int restart = 0; restart < 50; ++restart)
      ASSERT_GE(minimise(objective, randomStart(objective, random)).value, least - 1e-6) << task;
  }
}

TEST(PsychometricFit, GradientsAreThoseOfDifferences) {
  for (const std::string& name : psychometrics::sigmoidNames()) {
    for (const char* task : kTasks) {
      FitSettings settings;
      settings.sigmoid = psychometrics::sigmoidFamily(name);
      settings.task = readFitTask(task, "");
      settings.method = FitMethod::MaximumPosterior;
      settings.overdispersion = true;
      Random random(psychometrics::childSeed(13, name + task));
      const Objective objective({randomSet(settings, random)}, settings);
      for (int point = 0; point < 5; ++point) {
        std::vector<double> x;
        for (const FreeParameter& free : objective.free())
          x.push_back(free.low + (free.high - free.low) * random.uniform(0.1, 0.6));
        std::vector<double> gradient(x.size());
        if (!std::isfinite(objective.evaluate(x.data(), gradient.data()))) continue;
        for (size_t j = 0; j < x.size(); ++j) {
          const double step = 1e-5;
          std::vector<double> up = x, down = x;
          up[j] += step;
          down[j] -= step;
          const double difference =
              (objective.evaluate(up.data(), nullptr) - objective.evaluate(down.data(), nullptr)) /
              (2.0 * step);
          EXPECT_NEAR(gradient[j], difference, 1e-5 * std::max(1.0, std::abs(difference)))
              << name << task << j;
        }
      }
    }
  }
}

// k/n = 0.75 of two alternatives without lapses is F = 1/2: the threshold is the level itself, and the block
// is met exactly.
TEST(PsychometricFit, OneLevelWithKnownWidthIsMetExactly) {
  FitSettings settings;
  settings.fixed[indexOf(FitParameter::Width)] = 2.0;
  settings.fixed[indexOf(FitParameter::Lapse)] = 0.0;
  const Fit fit = fitPsychometric({{"", {{3.0, 75, 100, 0.0}}}}, settings);
  EXPECT_NEAR(threshold(fit), 3.0, 1e-9);
  EXPECT_NEAR(fit.deviance, 0.0, 1e-12);
  EXPECT_NEAR(fit.logLikelihood, logChoose(100, 75) + 75 * std::log(0.75) + 25 * std::log(0.25), 1e-9);
}

// Log odds of 1/4 and 3/4 at 0 and 1 are -ln 3 and ln 3: threshold 1/2, scale 1/(2 ln 3); a width spans 2 ln
// 19 scales. Two levels are met exactly by two parameters.
TEST(PsychometricFit, TwoLevelsAreMetExactly) {
  FitSettings settings;
  settings.sigmoid = SigmoidFamily::Logistic;
  settings.task = readFitTask("yesno", "");
  settings.fixed[indexOf(FitParameter::Guess)] = settings.fixed[indexOf(FitParameter::Lapse)] = 0.0;
  const Fit fit = fitPsychometric({{"", {{0.0, 25, 100, 0.0}, {1.0, 75, 100, 0.0}}}}, settings);
  EXPECT_NEAR(threshold(fit), 0.5, 1e-10);
  EXPECT_NEAR(width(fit), std::log(19.0) / std::log(3.0), 1e-9);
  EXPECT_NEAR(fit.deviance, 0.0, 1e-12);
  // Logistic: dF/dx = 1/4 over the scale.
  EXPECT_NEAR(fit.conditions[0].slope, 0.25 * 2.0 * std::log(3.0), 1e-9);
  // Another F moves the threshold along the same curve: F = 0.75 is at level 1.
  settings.thresholdLevel = 0.75;
  EXPECT_NEAR(threshold(fitPsychometric({{"", {{0.0, 25, 100, 0.0}, {1.0, 75, 100, 0.0}}}}, settings)), 1.0,
              1e-9);
}

TEST(PsychometricFit, LogarithmicAxisIsTheLinearOneOfLogarithms) {
  FitSettings linear, logarithmic;
  logarithmic.axis = StimulusAxis::Logarithmic;
  Condition logs = classicSet();
  for (Block& block : logs.blocks) block.level = std::log(block.level);
  for (const SigmoidFamily family : {SigmoidFamily::Logistic, SigmoidFamily::Gumbel}) {
    linear.sigmoid = logarithmic.sigmoid = family;
    const Fit a = fitPsychometric({logs}, linear), b = fitPsychometric({classicSet()}, logarithmic);
    EXPECT_NEAR(std::exp(threshold(a)), threshold(b), 1e-9 * threshold(b));
    EXPECT_NEAR(width(a), width(b), 1e-7);
  }
  // The Weibull is the Gumbel of the logarithm, whatever the axis is called.
  FitSettings weibull;
  weibull.sigmoid = SigmoidFamily::Weibull;
  EXPECT_EQ(threshold(fitPsychometric({classicSet()}, weibull)),
            threshold(fitPsychometric({classicSet()}, logarithmic)));
  // A blank (level 0) has F = 0: it tells the guess rate and nothing else.
  Condition blank = classicSet();
  blank.blocks.push_back({0.0, 45, 90, 0.0});
  EXPECT_NEAR(threshold(fitPsychometric({blank}, weibull)),
              threshold(fitPsychometric({classicSet()}, weibull)), 1e-9);
}

TEST(PsychometricFit, OverdispersedLikelihoodIsTheBetaBinomial) {
  FitSettings settings;
  settings.overdispersion = true;
  Condition wild = classicSet();
  for (size_t i = 0; i < wild.blocks.size(); ++i) wild.blocks[i].correct += i % 2 ? -12 : (i < 10 ? 12 : 0);
  const Fit fit = fitPsychometric({wild}, settings);
  const double eta = fit.conditions[0].value(FitParameter::Eta), nu = 1.0 / (eta * eta) - 1.0;
  EXPECT_GT(eta, 0.1);
  double sum = 0.0;
  for (const Block& block : wild.blocks) {
    const double k = static_cast<double>(block.correct), n = static_cast<double>(block.trials);
    const double p = fit.conditions[0].probability(settings, block.level), a = nu * p, b = nu * (1.0 - p);
    sum += logChoose(n, k) + std::lgamma(k + a) + std::lgamma(n - k + b) - std::lgamma(n + a + b) +
           std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b);
  }
  EXPECT_NEAR(fit.logLikelihood, sum, 1e-8);
  EXPECT_GT(fit.logLikelihood, fitPsychometric({wild}, FitSettings{}).logLikelihood + 3.0);
}

// The mode against a search of likelihood times priors written out, around it.
TEST(PsychometricFit, PosteriorModeIsHighestAmongItsNeighbours) {
  FitSettings settings;
  settings.method = FitMethod::MaximumPosterior;
  Condition steep = classicSet();
  steep.blocks.resize(8);
  const Fit fit = fitPsychometric({steep}, settings);
  const auto posterior = [&](double t, double w, double l) {
    ConditionFit at = fit.conditions[0];
    at.values = {t, w, 0.5, l, 0.0};
    // Levels 0.001 to 0.0045, spacing 0.0005.
    const double range = 0.0035, spacing = 0.0005;
    double prior = 9.0 * std::log1p(-l);
    if (t > 0.0045) prior += std::log(0.5 + 0.5 * std::cos(std::numbers::pi * (t - 0.0045) / (0.5 * range)));
    if (w < 2 * spacing) prior += std::log(0.5 - 0.5 * std::cos(std::numbers::pi * (w - spacing) / spacing));
    if (w > range) prior += std::log(0.5 + 0.5 * std::cos(std::numbers::pi / 2 * (w - range) / range));
    return plainLogLikelihood(steep, settings, at) + prior;
  };
  const double best = posterior(threshold(fit), width(fit), lapse(fit));
  EXPECT_NEAR(best, fit.logPosterior(), 1e-8);
  for (int step = 1; step < 18; ++step) {
    const int i = step % 3 - 1, j = step / 3 % 3 - 1, k = step / 9;
    if (i == 0 && j == 0 && k == 0) continue;
    EXPECT_LT(posterior(threshold(fit) + 1e-6 * i, width(fit) + 1e-6 * j, lapse(fit) + 1e-5 * k), best);
  }
}

TEST(PsychometricFit, DegenerateAnswersGiveBoundsAndWarnings) {
  const auto set = [](std::vector<int> correct) {
    Condition condition;
    for (size_t i = 0; i < correct.size(); ++i)
      condition.blocks.push_back({static_cast<double>(i + 1), correct[i], 20, 0.0});
    return condition;
  };
  FitSettings yesNo;
  yesNo.task = readFitTask("yesno", "");
  for (const FitSettings& settings : {FitSettings{}, yesNo}) {
    const Fit all = fitPsychometric({set({20, 20, 20, 20})}, settings);
    EXPECT_TRUE(warns(all, "every answer is correct"));
    EXPECT_TRUE(warns(all, "threshold is at the lower bound"));
    EXPECT_DOUBLE_EQ(threshold(all), 1.0 - 3.0);  // a range below the lowest level
    const Fit none = fitPsychometric({set({0, 0, 0, 0})}, settings);
    EXPECT_TRUE(warns(none, "no answer is correct"));
    EXPECT_TRUE(warns(none, "threshold is at the upper bound"));
    EXPECT_DOUBLE_EQ(threshold(none), 4.0 + 3.0);
  }
  const Fit step = fitPsychometric({set({0, 0, 20, 20})}, yesNo);
  EXPECT_TRUE(warns(step, "within one step"));
  EXPECT_GT(threshold(step), 2.0);
  EXPECT_LT(threshold(step), 3.0);
  EXPECT_NEAR(width(step), 0.1, 1e-9);  // a tenth of the levels' distance
  EXPECT_TRUE(warns(fitPsychometric({set({19, 15, 12, 10})}, FitSettings{}), "worse with the level"));
}

TEST(PsychometricFit, RefusesWhatHasNoAnswer) {
  const auto message = [](const Condition& condition, const FitSettings& settings) -> std::string {
    try {
      fitPsychometric({condition}, settings, "data.csv");
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  FitSettings settings;
  EXPECT_THAT(message({"", {{1.0, 5, 10, 0.0}}}, settings), HasSubstr("one level"));
  EXPECT_THAT(message({"a", {{1.0, 0, 0, 0.0}, {2.0, 0, 0, 0.0}}}, settings), HasSubstr("no trials"));
  EXPECT_THAT(message({"", {}}, settings), HasSubstr("no trials"));
  EXPECT_THAT(message({"", {{1.0, 11, 10, 0.0}, {2.0, 1, 2, 0.0}}}, settings), HasSubstr("11 correct of 10"));
  EXPECT_THAT(message({"", {{1.0, 1, 10, 0.0}, {NAN, 1, 2, 0.0}}}, settings), HasSubstr("not a finite"));
  settings.axis = StimulusAxis::Logarithmic;
  EXPECT_THAT(message({"", {{-1.0, 1, 10, 0.0}, {2.0, 1, 2, 0.0}}}, settings), HasSubstr("logarithmic"));
  settings = {};
  settings.fixed[indexOf(FitParameter::Lapse)] = 0.6;
  EXPECT_THAT(message(classicSet(), settings), HasSubstr("less than 1"));
  settings = {};
  settings.fixed[indexOf(FitParameter::Guess)] = 0.1;
  EXPECT_THAT(message(classicSet(), settings), HasSubstr("task settles"));
  // A blank that was answered contradicts a guess rate of 0.
  settings = {};
  settings.task = readFitTask("yesno", "");
  settings.axis = StimulusAxis::Logarithmic;
  settings.fixed[indexOf(FitParameter::Guess)] = 0.0;
  EXPECT_THAT(message({"", {{0.0, 1, 10, 0.0}, {1.0, 2, 10, 0.0}, {2.0, 9, 10, 0.0}}}, settings),
              HasSubstr("no parameters"));
}

// A million answers a level pin the observer's own parameters down.
TEST(PsychometricFit, MillionsOfAnswersRecoverTheObserver) {
  const PsychometricFunction observer(
      Sigmoid::fromThresholdWidth(SigmoidFamily::Logistic, StimulusAxis::Linear, 0.3, 1.7), 0.5, 0.03);
  Condition condition;
  for (int i = 0; i <= 10; ++i) {
    const double x = -2.0 + 0.5 * i;
    condition.blocks.push_back({x, std::llround(1e6 * observer.probability(x)), 1000000, 0.0});
  }
  FitSettings settings;
  settings.sigmoid = SigmoidFamily::Logistic;
  const Fit fit = fitPsychometric({condition}, settings);
  EXPECT_NEAR(threshold(fit), 0.3, 1e-5);
  EXPECT_NEAR(width(fit), 1.7, 1e-5);
  EXPECT_NEAR(lapse(fit), 0.03, 1e-6);
  EXPECT_LT(fit.deviance, 1e-4);
}

TEST(LikelihoodRatio, ComparesSharedWithSeparateParameters) {
  FitSettings separate, shared;
  shared.shared[indexOf(FitParameter::Width)] = shared.shared[indexOf(FitParameter::Lapse)] = true;
  Random random(3);
  const std::vector<Condition> conditions = {randomSet(separate, random), randomSet(separate, random)};
  const Fit full = fitPsychometric(conditions, separate), restricted = fitPsychometric(conditions, shared);
  EXPECT_EQ(full.freeParameters, 6u);
  EXPECT_EQ(restricted.freeParameters, 4u);
  EXPECT_NEAR(full.logLikelihood,
              fitPsychometric({conditions[0]}, separate).logLikelihood +
                  fitPsychometric({conditions[1]}, separate).logLikelihood,
              1e-9);
  const LikelihoodRatio ratio = likelihoodRatio(restricted, full);
  EXPECT_EQ(ratio.degrees, 2u);
  EXPECT_GT(ratio.statistic, 0.0);
  // Chi-squared with two degrees of freedom is exponential.
  EXPECT_NEAR(ratio.p, std::exp(-(full.logLikelihood - restricted.logLikelihood)), 1e-12);
}

}  // namespace
}  // namespace limen::analysis
