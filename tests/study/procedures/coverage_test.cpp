// SPDX-License-Identifier: BSD-3-Clause
// How often intervals hold the truth. Credible intervals promise their level for observers drawn from the
// prior, so thresholds are drawn from it, anywhere between the values of the grid; slopes and lapses from the
// grid's own values. With 1000 observers a coverage of 95 % has a standard error of 0.7 %: 93 to 97 % is 2.9
// of them either way.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "perception/psychometrics/psychometric_function.h"
#include "perception/psychometrics/random.h"
#include "study/procedures/procedure.h"

namespace limen::study {
namespace {

using nlohmann::json;
using psychometrics::PsychometricFunction;
using psychometrics::Random;
using psychometrics::Sigmoid;

struct Observer {
  double truth;  // the first parameter of the estimate
  PsychometricFunction function;
};

// Share of observers whose truth lies in the interval, and mean of estimate - truth.
struct Coverage {
  double share = 0.0, bias = 0.0;
};

Coverage measure(const json& settings, int observers, const std::function<Observer(Random&)>& draw) {
  const ProcedureSettings read = readProcedure(settings, "");
  Coverage out;
  for (int i = 0; i < observers; ++i) {
    const uint64_t seed = psychometrics::childSeed(17, std::to_string(i));
    Random random(seed);
    const Observer observer = draw(random);
    const auto procedure = makeProcedure(read, seed);
    while (const auto next = procedure->next()) {
      procedure->update(*next, random.chance(observer.function.probability(next->front())) ? 1 : 0);
    }
    const ParameterEstimate estimate = procedure->estimate().parameters.front();
    out.share += estimate.low <= observer.truth && observer.truth <= estimate.high ? 1.0 / observers : 0.0;
    out.bias += (estimate.mean - observer.truth) / observers;
  }
  testing::Test::RecordProperty("coverage", std::to_string(out.share));
  return out;
}

void expectNominal(const Coverage& coverage) {
  EXPECT_GE(coverage.share, 0.93);
  EXPECT_LE(coverage.share, 0.97);
}

TEST(Coverage, QuestHoldsThresholdsFromItsPrior) {
  const Coverage c = measure(
      {{"type", "quest"},
       {"threshold_guess", -1},
       {"threshold_guess_sd", 0.6},
       {"grain", 0.02},
       {"stop", {{"trials", 30}}}},
      1000, [](Random& random) {
        const double threshold = random.normal(-1, 0.6);
        // P(threshold) = 0.82, the default.
        const double shift = PsychometricFunction::watsonPelli(0, 3.5, 0.01, 0.5).inverse(0.82);
        return Observer{threshold, PsychometricFunction::watsonPelli(threshold - shift, 3.5, 0.01, 0.5)};
      });
  expectNominal(c);
  EXPECT_NEAR(c.bias, 0, 0.02);
}

TEST(Coverage, QuestPlusHoldsThresholdsWithSlopeAndLapseUnknown) {
  const json settings = {{"type", "quest_plus"},
                         {"stimulus", {{"name", "contrast"}, {"from", -40}, {"to", 0}, {"step", 2}}},
                         {"parameters",
                          {{"threshold", {{"from", -35}, {"to", -5}, {"step", 1}}},
                           {"slope", {2, 3.5, 5}},
                           {"lapse", {0.01, 0.04}}}},
                         {"stop", {{"trials", 40}}}};
  const auto draw = [](Random& random) {
    const double slopes[] = {2, 3.5, 5}, lapses[] = {0.01, 0.04};
    const double threshold = random.uniform(-35, -5);
    const double slope = slopes[random.below(3)];
    return Observer{threshold, PsychometricFunction::watson(threshold, slope, 0.5, lapses[random.below(2)])};
  };
  expectNominal(measure(settings, 1000, draw));
  json shortest = settings;
  shortest["interval"] = "highest_density";
  expectNominal(measure(shortest, 1000, draw));
}

TEST(Coverage, PsiMarginalHoldsThresholdsWithSlopeUnknown) {
  const json settings = {{"type", "psi"},
                         {"stimulus", {{"name", "level"}, {"from", -3}, {"to", 3}, {"step", 0.25}}},
                         {"parameters",
                          {{"threshold", {{"from", -2}, {"to", 2}, {"step", 0.1}}},
                           {"slope", {{"from", 1}, {"to", 8}, {"count", 4}, {"spacing", "log"}}},
                           {"guess", 0},
                           {"lapse", 0.02}}},
                         {"nuisance", {"slope"}},
                         {"stop", {{"trials", 30}}}};
  expectNominal(measure(settings, 1000, [](Random& random) {
    const double threshold = random.uniform(-2, 2);
    const double slope = std::pow(2.0, static_cast<double>(random.below(4)));
    return Observer{threshold, PsychometricFunction::yesNo(Sigmoid::logistic(threshold, slope), 0, 0.02)};
  }));
}

// The interval of a staircase promises less: what its documentation says of 8 and of 32 reversals, with three
// standard errors more on either side.
TEST(Coverage, StaircasesHoldTheirTargetAsOftenAsDocumented) {
  const auto share = [](int reversals) {
    const json settings = {{"type", "staircase"},
                           {"stimulus", {{"name", "level"}, {"start", 12}}},
                           {"steps", {4, 2, 1}},
                           {"down", 2},
                           {"estimate_reversals", reversals},
                           {"stop", {{"reversals", reversals + 2}}}};
    const Coverage c = measure(settings, 1000, [](Random& random) {
      const auto function = PsychometricFunction::yesNo(Sigmoid::normal(random.uniform(-0.5, 0.5), 2));
      return Observer{function.inverse(std::sqrt(0.5)), function};
    });
    EXPECT_NEAR(c.bias, 0, 0.2);  // a tenth of the SD
    return c.share;
  };
  const double few = share(8), many = share(32);
  EXPECT_GT(few, 0.61 - 0.05);
  EXPECT_LT(few, 0.86 + 0.04);
  EXPECT_GT(many, 0.89 - 0.03);
  EXPECT_LT(many, 0.94 + 0.03);
}

}  // namespace
}  // namespace limen::study
