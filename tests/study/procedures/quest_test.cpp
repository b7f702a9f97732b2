// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "perception/psychometrics/random.h"
#include "study/procedures/procedure.h"

namespace limen::study {
namespace {

using nlohmann::json;

ParameterEstimate threshold(const Procedure& procedure) { return procedure.estimate().parameters.front(); }

// Ten answers to the quantile that QUEST proposes, published with MATLAB's result, 79.073768 (the posterior's
// mean; its SD 4.173877), by the authors of jsQUEST. The grid ends at 90 with a grain of 0.01; that program
// finds the shift of the psychometric function by linear interpolation in steps of a grain, which is exact
// here to 1e-4.
TEST(Quest, ReproducesAPublishedRun) {
  const json settings = {{"type", "quest"},
                         {"threshold_guess", 50},
                         {"threshold_guess_sd", 50},
                         {"range", 80},
                         {"stop", {{"trials", 10}}}};
  const auto procedure = makeProcedure(readProcedure(settings, ""), 1);
  for (int answer : {1, 1, 0, 0, 1, 1, 0, 0, 1, 1}) procedure->update(*procedure->next(), answer);
  EXPECT_FALSE(procedure->next());
  EXPECT_NEAR(threshold(*procedure).mean, 79.073768, 1e-4);
}

// The demonstration run of the VisionEgg's port of Pelli's programs: stimuli, answers and the mean at the
// end, 0.60.
TEST(Quest, ReproducesThePublishedDemonstration) {
  const json settings = {
      {"type", "quest"}, {"threshold_guess", 0.4}, {"threshold_guess_sd", 2}, {"stop", {{"trials", 10}}}};
  const auto procedure = makeProcedure(readProcedure(settings, ""), 1);
  const std::vector<std::pair<double, int>> trials = {{0.7, 1}, {0.4, 1}, {-0.2, 0}, {0.7, 1}, {0.4, 1},
                                                      {0.4, 0}, {1.1, 1}, {0.9, 1},  {0.7, 1}, {0.7, 1}};
  for (const auto& [stimulus, answer] : trials) procedure->update({stimulus}, answer);
  EXPECT_NEAR(threshold(*procedure).mean, 0.60, 0.05);  // printed to two digits, stimuli to one
}

// Bayes' rule from its definition in the wider type, over a run with stimuli on the grid.
TEST(Quest, PosteriorIsBayesRule) {
  const json settings = {{"type", "quest"},
                         {"threshold_guess", -1},
                         {"threshold_guess_sd", 1.5},
                         {"beta", 2.5},
                         {"delta", 0.02},
                         {"gamma", 0.25},
                         {"grain", 0.05},
                         {"range", 6},
                         {"threshold_probability", 0.7},
                         {"next", "mean"},
                         {"stop", {{"trials", 30}}}};
  const auto procedure = makeProcedure(readProcedure(settings, ""), 1);
  psychometrics::Random random(5);
  std::vector<long double> posterior;
  for (int i = -60; i <= 60; ++i)
    posterior.push_back(std::exp(-0.5L * (i * 0.05L / 1.5L) * (i * 0.05L / 1.5L)));
  // P at threshold: 0.02 * 0.25 + 0.98 (1 - 0.75 e^-w) = 0.7, hence w; x is shifted by log10(w) / beta.
  const long double w = -std::log((1 - (0.7L - 0.005L) / 0.98L) / 0.75L), shift = std::log10(w) / 2.5L;
  for (int trial = 0; trial < 30; ++trial) {
    const double stimulus = -1 + 0.05 * std::round((*procedure->next())[0] / 0.05 + 20);
    const int answer = random.chance(0.7) ? 1 : 0;
    long double sum = 0, mean = 0;
    for (int i = -60; i <= 60; ++i) {
      const long double x = stimulus - (-1 + i * 0.05L) + shift;
      const long double p = 0.005L + 0.98L * (1 - 0.75L * std::exp(-std::pow(10.0L, 2.5L * x)));
      long double& weight = posterior[static_cast<size_t>(i + 60)];
      weight *= answer == 1 ? p : 1 - p;
      sum += weight;
      mean += weight * (-1 + i * 0.05L);
    }
    procedure->update({stimulus}, answer);
    ASSERT_NEAR(threshold(*procedure).mean, static_cast<double>(mean / sum), 1e-10) << "trial " << trial + 1;
    if (trial < 29) {
      EXPECT_NEAR((*procedure->next())[0], static_cast<double>(mean / sum), 1e-10);
    }
  }
}

TEST(Quest, StimulusStaysWithinItsLimits) {
  const json settings = {{"type", "quest"},
                         {"stimulus", {{"name", "contrast"}, {"minimum", -2}, {"maximum", -0.5}}},
                         {"threshold_guess", 0},
                         {"threshold_guess_sd", 1},
                         {"stop", {{"sd", 0.2}, {"trials", 500}}}};
  const auto procedure = makeProcedure(readProcedure(settings, ""), 1);
  EXPECT_EQ((*procedure->next())[0], -0.5);
  int trials = 0;
  while (const auto next = procedure->next()) {
    EXPECT_GE((*next)[0], -2);
    procedure->update(*next, trials++ % 5 == 0 ? 0 : 1);
  }
  EXPECT_LT(trials, 500);
}

}  // namespace
}  // namespace limen::study
