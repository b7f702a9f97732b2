// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "analysis/statistics/detection_rates.h"
#include "analysis/statistics/multiple_comparisons.h"
#include "analysis/statistics/signal_detection.h"
#include "tests/analysis/statistics/expect.h"

namespace limen::analysis {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void expectInterval(const Interval& interval, double low, double high, double tolerance = 1e-9) {
  EXPECT_LE(std::abs(interval.low - low), tolerance * std::abs(low)) << interval.low << " for " << low;
  EXPECT_LE(std::abs(interval.high - high), tolerance * std::abs(high)) << interval.high << " for " << high;
}

// Intervals from R: reference/rates.R.
TEST(DetectionRate, IntervalsAreThoseOfR) {
  // 455 of 672 change trials and 10 of 224 catch trials: Schwarz 2009, section 10.4.1, 67.71 % and 4.46 %.
  const Rate change = detectionRate(455, 672), caught = detectionRate(10, 224);
  EXPECT_NEAR(change.rate, 0.6771, 5e-5);
  EXPECT_NEAR(caught.rate, 0.0446, 5e-5);
  expectInterval(change.wilson, 0.640809765402705, 0.711343830523915);
  expectInterval(change.clopperPearson, 0.640265864669344, 0.712336684351896);
  expectInterval(caught.wilson, 0.0244271036737177, 0.0802134606208464);
  expectInterval(caught.clopperPearson, 0.0216125872447232, 0.0805654421512354);
  expectInterval(wilsonInterval(7, 9, 0.9), 0.503642782376754, 0.923505262445604);
}

TEST(DetectionRate, IntervalsHoldAtTheEdgesAndForAMillionTrials) {
  expectInterval(wilsonInterval(0, 20), 0.0, 0.161125158052819);
  expectInterval(clopperPearsonInterval(0, 20), 0.0, 0.168433470983085);
  expectInterval(wilsonInterval(20, 20), 0.838874841947181, 1.0);
  expectInterval(clopperPearsonInterval(20, 20), 0.831566529016915, 1.0);
  expectInterval(wilsonInterval(1, 1000000), 1.76524576745372e-07, 5.66491180431144e-06, 1e-6);
  expectInterval(clopperPearsonInterval(1, 1000000), 2.53178076637942e-08, 5.57163065517224e-06);
  expectInterval(wilsonInterval(987654, 1000000), 0.987435690916105, 0.987868562492768);
  expectInterval(clopperPearsonInterval(987654, 1000000), 0.987435653686769, 0.987869514833064);
}

TEST(DetectionRate, BadCountsAreRefusedByIndex) {
  expectError([] { detectionRate(5, 4); }, "successes");
  expectError([] { detectionRate(-1, 4); }, "successes");
  expectError([] { detectionRate(0, 0); }, "successes");
  expectError([] { detectionRate(1, 4, 1.0); }, "level");
}

TEST(MeanOverSubjects, IntervalIsThatOfR) {
  const MeanOverSubjects m = meanOverSubjects({0.55, 0.71, 0.82, 0.64, 0.60, 0.77, 0.49, 0.84});
  expectInterval(*m.interval, 0.570274002014098, 0.784725997985902);
  EXPECT_FALSE(meanOverSubjects({0.5}).interval);
  for (size_t n = 2; n < 60; ++n) EXPECT_EQ(meanOverSubjects(std::vector<double>(n, 1.0)).mean, 1.0);
  EXPECT_EQ(meanOverSubjects({0.5}).mean, 0.5);
  expectError([] { meanOverSubjects({0.5, kNan}); }, "values[1]");
  expectError([] { meanOverSubjects({}); }, "values");
}

TEST(SignalDetection, YesNoValuesAreThoseOfTheFormulasInR) {
  const YesNoSensitivity s = analyseYesNo({38, 50, 9, 40});
  expectRelative(s.dPrime, 1.4232327760442947, 1e-12);
  expectRelative(s.criterion, 0.0216193951633645, 1e-12);
  expectRelative(s.lnBeta, 0.0307694317947538, 1e-12);
  expectRelative(s.beta, 1.0312477035408072, 1e-12);
  expectRelative(s.dPrimeError, 0.292062376369623, 1e-12);
  expectRelative(s.criterionError, 0.146031188184811, 1e-12);
  expectRelative(s.lnBetaError, 0.208703489557567, 1e-12);
  expectInterval(s.dPrimeInterval, 1.4232327760442947 - 1.959963984540054 * 0.292062376369623,
                 1.4232327760442947 + 1.959963984540054 * 0.292062376369623);
  // R's derivatives are differences. The opposite answers have A' as far below 1/2 and the same error.
  expectRelative(s.aPrimeError, 0.038947368441274, 1e-7);
  expectRelative(analyseYesNo({9, 40, 38, 50}).aPrimeError, s.aPrimeError, 1e-12);
  EXPECT_NEAR(analyseYesNo({9, 40, 38, 50}).aPrime, 1.0 - s.aPrime, 1e-14);
  EXPECT_EQ(analyseYesNo({50, 50, 0, 50}).aPrimeInterval.high, 1.0);
  expectRelative(analyseYesNo({38, 50, 9, 40}, RateCorrection::kNone).dPrime, 1.46171758920056, 1e-12);
}

TEST(SignalDetection, PerfectAnswersStayFiniteWithCorrectionAndAreRefusedWithout) {
  const YesNoSensitivity s = analyseYesNo({1000000, 1000000, 0, 1000000});
  // Both rates are 0.5 / 1000001 from the end: z = 4.8916 each way, no bias.
  EXPECT_NEAR(s.dPrime, 2.0 * 4.891638, 1e-5);
  EXPECT_NEAR(s.criterion, 0.0, 1e-9);
  expectError([] { analyseYesNo({10, 10, 3, 10}, RateCorrection::kNone); }, "hits");
  expectError([] { analyseYesNo({5, 10, 0, 10}, RateCorrection::kNone); }, "log-linear");
  expectError([] { analyseYesNo({11, 10, 3, 10}); }, "hits: 11 of 10");
  expectError([] { analyseYesNo({5, 10, 0, 0}); }, "falseAlarms");
}

TEST(SignalDetection, APrimeIsThatOfItsAnchors) {
  EXPECT_EQ(aPrime(0.4, 0.4), 0.5);
  EXPECT_EQ(aPrime(1.0, 0.0), 1.0);
  EXPECT_EQ(aPrime(0.0, 1.0), 0.0);
  // H = 0.8, F = 0.2: 1/2 + 0.6 1.6 / (4 0.8 0.8) = 0.875, and as far below for the opposite.
  EXPECT_NEAR(aPrime(0.8, 0.2), 0.875, 1e-15);
  EXPECT_NEAR(aPrime(0.2, 0.8), 0.125, 1e-15);
  expectError([] { aPrime(1.5, 0.2); }, "hitRate");
}

TEST(SignalDetection, ProportionsOfManyAlternativesAreTheIntegrals) {
  const struct {
    double d;
    int m;
    double p;
  } cases[] = {{-1, 2, 0.239750061093477},
               {1, 2, 0.760249938906523},
               {-1, 3, 0.113202167965033},
               {0.5, 3, 0.482592870894904},
               {2.5, 3, 0.931365241260447},
               {1, 4, 0.552031438443016},
               {0, 8, 0.125},
               {1, 8, 0.385480977732248},
               {2.5, 8, 0.83519669926692},
               {1, 1000, 0.0166038994657378},
               {2.5, 1000, 0.242692212770425},
               {0, 1000, 0.001}};
  for (const auto& c : cases) {
    expectRelative(mAfcProportionCorrect(c.d, c.m), c.p, 1e-9);  // R's quadrature has its own error
    EXPECT_NEAR(mAfcProportionWrong(c.d, c.m), 1.0 - c.p, 1e-9);
    EXPECT_NEAR(mAfcDPrime(c.p, c.m), c.d, 1e-7);
  }
  expectRelative(mAfcDPrime(0.75, 3), 1.43383058749706, 1e-9);
  expectRelative(mAfcDPrime(0.75, 4), 1.68219519520334, 1e-9);
}

// Expected values from reference/tails.py.
TEST(SignalDetection, ProportionsOfManyAlternativesKeepTheirDigitsFarOut) {
  expectRelative(mAfcProportionWrong(8.0, 3), 1.5411026805029372e-8, 1e-12);
  expectRelative(mAfcProportionWrong(12.0, 4), 3.2279581891440704e-17, 1e-12);
  expectRelative(mAfcProportionCorrect(-6.0, 3), 1.163320937779937e-7, 1e-12);
  EXPECT_NEAR(mAfcDPrime(1.163320937779937e-7, 3), -6.0, 1e-9);
  // Below any double that the integrand itself could hold on the way, the inverse still returns.
  for (const int m : {2, 3, 10, 1000}) {
    const double d = mAfcDPrime(1e-300, m);
    EXPECT_LT(d, -30.0);
    expectRelative(mAfcProportionCorrect(d, m), 1e-300, 1e-9);
  }
}

TEST(SignalDetection, CountsOfManyAlternativesHaveErrorsAndBounds) {
  const MAfcSensitivity s = analyseMAfc(60, 80, 4, RateCorrection::kNone);
  expectRelative(s.dPrime, 1.682195195203338, 1e-9);
  expectRelative(s.dPrimeError, 0.192030420138278, 1e-6);
  expectRelative(*s.low, 1.302230262139593, 1e-9);
  expectRelative(*s.high, 2.045328129533326, 1e-9);
  const MAfcSensitivity perfect = analyseMAfc(80, 80, 4);
  EXPECT_TRUE(std::isfinite(perfect.dPrime));
  EXPECT_TRUE(perfect.low.has_value());
  EXPECT_FALSE(perfect.high.has_value());
  expectError([] { analyseMAfc(80, 80, 4, RateCorrection::kNone); }, "correct");
  expectError([] { analyseMAfc(8, 80, 1); }, "alternatives");
  expectError([] { mAfcDPrime(1.0, 4); }, "proportionCorrect");
  expectError([] { mAfcProportionCorrect(kNan, 4); }, "d'");
}

TEST(MultipleComparisons, AdjustmentsAreThoseOfR) {
  // reference/anova.R: p.adjust.
  const std::vector<double> p = {0.0171060615888920, 0.00131197019836125,  1.61465138721536e-04,
                                 0.0178803905243052, 1.57978552110046e-04, 0.00274982614526104};
  const std::vector<double> holm = {0.034212123177784021, 0.005247880793445014, 0.000947871312660277,
                                    0.034212123177784021, 0.000947871312660277, 0.008249478435783131};
  for (size_t i = 0; i < p.size(); ++i) expectRelative(adjustHolm(p)[i], holm[i], 1e-12);
  EXPECT_TRUE(adjustHolm({}).empty());
  expectError([] { adjustHolm({0.2, 1.5}); }, "p[1]");
  expectError([] { adjustHolm({kNan}); }, "p[0]");
  struct Row {
    std::optional<double> p, adjusted;
  };
  std::vector<Row> rows = {{p[0], {}}, {{}, {}}, {p[1], {}}};
  adjustHolm(rows, &Row::p, &Row::adjusted);
  // Of two: the smaller twice, the larger as it is.
  expectRelative(rows[0].adjusted.value(), p[0], 1e-15);
  EXPECT_FALSE(rows[1].adjusted);
  expectRelative(rows[2].adjusted.value(), 2.0 * p[1], 1e-15);
}

}  // namespace
}  // namespace limen::analysis
