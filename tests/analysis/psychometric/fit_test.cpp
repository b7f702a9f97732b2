// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/psychometric/fit.h"

#include <gtest/gtest.h>

namespace limen::analysis {
namespace {

Condition classic() {
  const double levels[] = {.0010, .0015, .0020, .0025, .0030, .0035, .0040,
                           .0045, .0050, .0060, .0070, .0080, .0100};
  const int correct[] = {45, 50, 44, 44, 52, 53, 62, 64, 76, 79, 88, 90, 90};
  Condition condition;
  for (size_t i = 0; i < 13; ++i) condition.blocks.push_back({levels[i], correct[i], 90, 0.0});
  return condition;
}

// The example data of psignifit 4, whose answer all implementations agree on.
TEST(PsychometricFit, FindsThePublishedMaximumOfTheClassicSet) {
  const Fit fit = fitPsychometric({classic()}, FitSettings{});
  EXPECT_NEAR(fit.conditions[0].value(FitParameter::Threshold), 0.0046478171, 5e-11);
  EXPECT_NEAR(fit.conditions[0].value(FitParameter::Width), 0.0046590718, 5e-11);
  EXPECT_NEAR(fit.conditions[0].deviance, 5.9328130, 5e-8);
  printf("lapse %g aic %g\n", fit.conditions[0].value(FitParameter::Lapse), fit.aic);
}

}  // namespace
}  // namespace limen::analysis
