// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/psychometric/fit.h"

#include <gtest/gtest.h>

#include "tests/analysis/psychometric/simulated_sets.h"

namespace limen::analysis {
namespace {

// The example data of psignifit 4, whose answer all implementations agree on.
TEST(PsychometricFit, FindsThePublishedMaximumOfTheClassicSet) {
  const Fit fit = fitPsychometric({classicSet()}, FitSettings{});
  EXPECT_NEAR(fit.conditions[0].value(FitParameter::Threshold), 0.0046478171, 5e-11);
  EXPECT_NEAR(fit.conditions[0].value(FitParameter::Width), 0.0046590718, 5e-11);
  EXPECT_NEAR(fit.conditions[0].deviance, 5.9328130, 5e-8);
  printf("lapse %g aic %g\n", fit.conditions[0].value(FitParameter::Lapse), fit.aic);
}

}  // namespace
}  // namespace limen::analysis
