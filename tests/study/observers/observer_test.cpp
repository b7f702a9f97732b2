// SPDX-License-Identifier: BSD-3-Clause
#include "study/observers/observer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <functional>

#include "experiments/base/error.h"
#include "perception/psychometrics/random.h"
#include "tests/study/observers/binomial.h"
#include "tests/study/observers/example.h"

namespace limen::study {
namespace {

using ::testing::HasSubstr;

double phi(double z) { return boost::math::cdf(boost::math::normal(), z); }
double phiInverse(double p) { return boost::math::quantile(boost::math::normal(), p); }
double logistic(double z) { return 1.0 / (1.0 + std::exp(-z)); }

ObserverBehaviour behaviourOf(const std::string& kind, const std::vector<std::string>& settings = {}) {
  return chooseObserver(kind, settings).behaviour;
}

int count(SimulatedObserver& observer, Trial trial, int trials,
          const std::function<bool(const ObserverResponse&)>& what) {
  int out = 0;
  for (int i = 0; i < trials; ++i) {
    trial.seed = psychometrics::childSeed(17, std::to_string(i));
    out += what(observer.respond(trial));
  }
  return out;
}

bool isYes(const ObserverResponse& response) { return response.answer == "yes"; }

// Falling from 1 to 0; width 2 ln 19 from F = 0.95 to 0.05, so that F = logistic(7 - distance).
const std::string kFalling =
    "simulation: {variable: distance, direction: falling, threshold: 7, width: 5.888877957610, guess: 0.1, "
    "lapse: 0.04";

TEST(Observer, SaysYesAsOftenAsTheDeclaredFunctionSays) {
  const Protocol protocol = boxProtocol(kYesNo + kFalling + "}");
  const Simulation simulation(protocol);
  SimulatedObserver lapsing(simulation, behaviourOf("lapsing"), 1),
      ideal(simulation, behaviourOf("ideal"), 1);
  SimulatedObserver other(
      simulation, behaviourOf("lapsing", {"lapse=own", "lapse.value=0.3", "guess=own", "guess.value=0.2"}),
      1);
  for (const double distance : {4.0, 10.0}) {
    const Trial trial = trialOf(protocol, true, {{"distance", distance == 4.0 ? "4" : "10"}});
    const double f = logistic(7.0 - distance);
    EXPECT_TRUE(isRate(count(lapsing, trial, 3000, isYes), 3000, 0.1 + 0.86 * f));
    EXPECT_TRUE(isRate(count(ideal, trial, 3000, isYes), 3000, 0.1 + 0.9 * f));
    EXPECT_TRUE(isRate(count(other, trial, 3000, isYes), 3000, 0.2 + 0.5 * f));
    EXPECT_NEAR(lapsing.probability(trial), 0.1 + 0.86 * f, 1e-9);
  }
  const Trial nothing = trialOf(protocol, false);
  EXPECT_TRUE(isRate(count(lapsing, nothing, 3000, isYes), 3000, 0.1));
  EXPECT_TRUE(isRate(count(ideal, nothing, 3000, isYes), 3000, 0.1));
}

TEST(Observer, OneOfTheSameSeedAnswersAlikeWhateverCameBefore) {
  const Protocol protocol = boxProtocol(kYesNo + kFalling + ", between_observers: {threshold_sd_log: 0.5}}");
  const Simulation simulation(protocol);
  SimulatedObserver first(simulation, behaviourOf("lapsing"), 5),
      second(simulation, behaviourOf("lapsing"), 5);
  Trial trial = trialOf(protocol, true);
  for (int i = 0; i < 50; ++i) {
    trial.seed = static_cast<uint64_t>(i);
    first.respond(trial);
  }
  for (int i = 49; i >= 0; --i) {
    trial.seed = static_cast<uint64_t>(i);
    const ObserverResponse a = first.respond(trial), b = second.respond(trial);
    EXPECT_EQ(a.answer, b.answer);
    EXPECT_EQ(a.reactionTimeS, b.reactionTimeS);
  }
}

TEST(Observer, BiasedCriterionGivesTheRatesOfSignalDetection) {
  const Protocol protocol =
      boxProtocol(kYesNo + "simulation: {theory: signal_detection, detected: 0.5, guess: 0.1}\n");
  const Simulation simulation(protocol);
  SimulatedObserver observer(simulation, behaviourOf("biased", {"criterion_shift=0.8"}), 1);
  // Unbiased: hits 0.1 + 0.9 * 0.5 = 0.55, false alarms 0.1.
  const double hits = phi(phiInverse(0.55) - 0.8), alarms = phi(phiInverse(0.1) - 0.8);
  EXPECT_TRUE(isRate(count(observer, trialOf(protocol, true), 5000, isYes), 5000, hits));
  EXPECT_TRUE(isRate(count(observer, trialOf(protocol, false), 5000, isYes), 5000, alarms));
}

TEST(Observer, DriftingOneMovesAlongTheSigmoidAndLapsesMore) {
  const Protocol protocol = boxProtocol(kYesNo + kFalling + "}");
  const Simulation simulation(protocol);
  SimulatedObserver observer(simulation,
                             behaviourOf("drifting", {"strength_per_100=-1.5", "lapse_per_100=0.05"}), 1);
  Trial trial = trialOf(protocol, true, {{"distance", "4"}});
  for (const int number : {0, 100, 400}) {
    trial.plan.number = number;
    // logit F = 7 - 4 - 1.5 n/100; lapse 0.04 + 0.05 n/100.
    const double f = logistic(3.0 - 1.5 * number / 100.0), lapse = 0.04 + 0.05 * number / 100.0;
    const double expected = 0.1 + (0.9 - lapse) * f;
    EXPECT_NEAR(observer.probability(trial), expected, 1e-9);
    EXPECT_TRUE(isRate(count(observer, trial, 2000, isYes), 2000, expected));
  }
}

TEST(Observer, ThresholdsOfObserversHaveTheDeclaredSpread) {
  const Protocol protocol = boxProtocol(kYesNo + kFalling + ", between_observers: {threshold_sd_log: 0.3}}");
  const Simulation simulation(protocol);
  const Trial trial = trialOf(protocol, true, {{"distance", "10"}});
  double sum = 0.0, squares = 0.0;
  constexpr int kObservers = 2000;
  for (int i = 0; i < kObservers; ++i) {
    SimulatedObserver observer(simulation, behaviourOf("ideal"), static_cast<uint64_t>(i));
    // F = logistic(threshold - 10), solved for the threshold.
    const double f = observer.detected(trial);
    const double z = std::log((10.0 + std::log(f / (1.0 - f))) / 7.0);
    sum += z;
    squares += z * z;
  }
  // Five standard errors: 0.3 / sqrt(2000) of the mean, 0.3 / sqrt(4000) of the SD.
  EXPECT_NEAR(sum / kObservers, 0.0, 5.0 * 0.3 / std::sqrt(2000.0));
  EXPECT_NEAR(std::sqrt(squares / kObservers), 0.3, 5.0 * 0.3 / std::sqrt(4000.0));
}

TEST(Observer, SeverityIsTheStepThatTheEvidenceReaches) {
  const Protocol protocol = boxProtocol(R"(
task: {type: yes_no, question: "Seen?", severity: {question: "How much?", labels: [little, more, much]}}
factors: {distance: [4, 10]}
stimulus:
  scene: {name: box, distance: = distance}
  levels: {before: 1, after: 0}
trials: {change: 2, catch: 1}
simulation: {theory: signal_detection, detected: 0.7, guess: 0.05, severity: [0.5, 1.5]}
)");
  const Simulation simulation(protocol);
  SimulatedObserver observer(simulation, behaviourOf("ideal"), 1);
  const Trial trial = trialOf(protocol, true);
  // Evidence is normal around z(hit rate), hits 0.05 + 0.95 * 0.7 = 0.715.
  const double mean = phiInverse(0.715);
  for (const int step : {2, 3}) {
    const double bound = step == 2 ? 0.5 : 1.5;
    EXPECT_TRUE(
        isRate(count(observer, trial, 4000, [&](const auto& r) { return r.severity && *r.severity >= step; }),
               4000, phi(mean - bound)));
  }
  EXPECT_TRUE(isRate(count(observer, trial, 4000, [](const auto& r) { return r.severity.has_value(); }), 4000,
                     0.715));
}

TEST(Observer, RatesAboveTheLeastAsOftenAsItWouldSayYes) {
  const Protocol protocol = boxProtocol(R"(
task: {type: rating, question: "How much?", answers: [none, little, more, much]}
factors: {distance: [4, 10]}
stimulus:
  scene: {name: box, distance: = distance}
  levels: {before: 1, after: 0}
trials: {change: 2, catch: 1}
)" + kFalling + "}");
  const Simulation simulation(protocol);
  SimulatedObserver observer(simulation, behaviourOf("lapsing"), 1);
  const auto aboveLeast = [](const ObserverResponse& r) { return r.outcome > 0; };
  EXPECT_TRUE(isRate(count(observer, trialOf(protocol, true, {{"distance", "4"}}), 3000, aboveLeast), 3000,
                     0.1 + 0.86 * logistic(3.0)));
  EXPECT_TRUE(isRate(count(observer, trialOf(protocol, false), 3000, aboveLeast), 3000, 0.1));
}

TEST(Observer, IntervalsAreToldAsOftenAsTheDeclaredFunctionSays) {
  const Protocol protocol = boxProtocol(R"(
task: {type: interval, alternatives: 3, question: "Which?", answers: [first, second, third]}
factors: {distance: [4, 10]}
stimulus:
  scene: {name: box, distance: = distance}
  levels: {before: 1, after: 0}
trials: {change: 3}
)" + kFalling + "}");
  const Simulation simulation(protocol);
  SimulatedObserver observer(simulation, behaviourOf("lapsing"), 1);
  Trial trial = trialOf(protocol, true, {{"distance", "10"}});
  const double expected = 1.0 / 3.0 + (2.0 / 3.0 - 0.04) * logistic(-3.0);
  for (int target = 0; target < 3; ++target) {
    trial.plan.target = target;
    const std::string right =
        std::vector<std::string>{"first", "second", "third"}[static_cast<size_t>(target)];
    EXPECT_TRUE(isRate(count(observer, trial, 2000, [&](const auto& r) { return r.answer == right; }), 2000,
                       expected));
    EXPECT_TRUE(
        isRate(count(observer, trial, 2000, [](const auto& r) { return r.outcome == 1; }), 2000, expected));
  }
}

TEST(Observer, PairsAreJudgedByScaleValues) {
  const Protocol protocol = boxProtocol(R"(
task: {type: pairwise, question: "Which is better?", answers: [left, right]}
items: size
factors:
  size:
    small: {distance: 20}
    large: {distance: 5}
stimulus:
  scene: {name: box, distance: = distance}
  levels: {before: 1, after: 0}
trials: {change: 2}
simulation: {items: {small: 0.2, large: 1.1}}
)");
  const Simulation simulation(protocol);
  SimulatedObserver observer(simulation, behaviourOf("ideal"), 1);
  Trial trial = trialOf(protocol, true);
  const bool bIsLarge = trial.plan.condition.at("item_b") == "large";
  const double large = phi(0.9 / std::sqrt(2.0));
  for (const int target : {0, 1}) {
    trial.plan.target = target;  // where item b is
    const std::string largeSide = (target == 1) == bIsLarge ? "right" : "left";
    EXPECT_TRUE(isRate(count(observer, trial, 3000, [&](const auto& r) { return r.answer == largeSide; }),
                       3000, large));
    EXPECT_NEAR(observer.probability(trial), bIsLarge ? large : 1.0 - large, 1e-9);
  }
}

// A model that says the same of every stimulus.
struct FixedModel : StimulusModel {
  StimulusPrediction prediction;
  StimulusPrediction predict(const Trial&, const Variables&, size_t) override { return prediction; }
};

TEST(Observer, WithoutABlockTheModelsDetectionProbabilityIsTheRate) {
  const Protocol protocol = boxProtocol(kYesNo);
  const Simulation simulation(protocol);
  EXPECT_TRUE(simulation.needsModel());
  FixedModel model;
  model.prediction = {2.3, true};
  SimulatedObserver observer(simulation, behaviourOf("model"), 1, &model);
  // g + (1 - g - l) logistic((R - m) / s) with the defaults of perception/popping/detection.h.
  const double expected = 0.0446 + (1.0 - 0.0446 - 0.02) * logistic(0.3 / 0.45512);
  EXPECT_NEAR(observer.probability(trialOf(protocol, true)), expected, 1e-9);
  EXPECT_TRUE(isRate(count(observer, trialOf(protocol, true), 3000, isYes), 3000, expected));
  EXPECT_TRUE(isRate(count(observer, trialOf(protocol, false), 3000, isYes), 3000, 0.0446));
  model.prediction = {-3.0, false};
  EXPECT_NEAR(observer.probability(trialOf(protocol, true)), 0.0446, 1e-12);
  SimulatedObserver blind(simulation, behaviourOf("model"), 1);
  EXPECT_THROW(blind.probability(trialOf(protocol, true)), Error);
}

std::string refusal(const std::string& block, const std::string& kind = "lapsing") {
  try {
    const Protocol protocol = boxProtocol(kYesNo + block);
    const Simulation simulation(protocol);
    SimulatedObserver observer(simulation, behaviourOf(kind), 1);
    observer.probability(trialOf(protocol, true));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Observer, BadBlocksAreRefusedWithTheirLine) {
  // kYesNo has seven lines, the first one empty.
  EXPECT_THAT(refusal("simulation:\n  treshold: 3"),
              AllOf(HasSubstr("test.yaml:9:"), HasSubstr("'threshold'")));
  EXPECT_THAT(refusal("simulation: {variable: distance, threshold: 3}"),
              HasSubstr("neither width nor slope"));
  EXPECT_THAT(refusal("simulation: {threshold: 3}"), HasSubstr("variable"));
  EXPECT_THAT(refusal("simulation: {variable: distanse, threshold: 3, width: 1}"), HasSubstr("distanse"));
  EXPECT_THAT(refusal("simulation: {variable: distance, threshold: 3, width: -1}"), HasSubstr("not above 0"));
  EXPECT_THAT(refusal("simulation: {detected: 1.2}"), HasSubstr("not a probability"));
  EXPECT_THAT(refusal("simulation: {detected: 0.5, guess: 0.7, lapse: 0.4}"), HasSubstr("less than 1"));
  EXPECT_THAT(refusal("simulation: {detected: 0.5, theory: signal_detection}"),
              HasSubstr("guess rate above 0"));
  EXPECT_THAT(refusal("simulation: {detected: 0.5, conditions: [{where: {distance: 5}, detected: 1}]}"),
              HasSubstr("no level '5'"));
  EXPECT_THAT(refusal("simulation: {detected: 0.5, parts: {mian: {detected: 1}}}"), HasSubstr("'main'"));
  EXPECT_THAT(refusal("simulation: {detected: 0.5, between_observers: {threshold_sdd: 1}}"),
              HasSubstr("threshold_sd"));
  EXPECT_EQ(refusal("simulation: {detected: 0.5, conditions: [{where: {distance: 4}, detected: 1}]}"), "");
}

TEST(Observer, BadSettingsAreRefused) {
  EXPECT_THROW(chooseObserver("idael"), Error);
  EXPECT_THROW(chooseObserver("lapsing", {"lapse"}), Error);
  EXPECT_THROW(chooseObserver("lapsing", {"laps=0.1"}), Error);
  EXPECT_THROW(chooseObserver("lapsing", {"lapse=much"}), Error);
  EXPECT_THROW(chooseObserver("lapsing", {"lapse.kind=own", "lapse=protocol"}), Error);
  EXPECT_THROW(chooseObserver("lapsing", {"lapse=own", "lapse.value=0.6", "guess=own", "guess.value=0.6"}),
               Error);
  EXPECT_THROW(chooseObserver("ideal", {"lapse=own"}), Error);
  EXPECT_THROW(chooseObserver("lapsing", {"lapse.value=0.1"}), Error);  // the protocol's: no value of its own
}

}  // namespace
}  // namespace limen::study
