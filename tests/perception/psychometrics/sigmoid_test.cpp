// SPDX-License-Identifier: BSD-3-Clause
#include "perception/psychometrics/sigmoid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/base/error.h"

namespace limen::psychometrics {
namespace {

using Real = long double;

constexpr Real kPi = std::numbers::pi_v<Real>;
constexpr double kSmallestNormal = std::numeric_limits<double>::min();

const SigmoidFamily kFamilies[] = {SigmoidFamily::Logistic,       SigmoidFamily::Normal,
                                   SigmoidFamily::Weibull,        SigmoidFamily::Gumbel,
                                   SigmoidFamily::ReversedGumbel, SigmoidFamily::HyperbolicSecant,
                                   SigmoidFamily::StudentT};

// The definitions, in the wider type: its exponent reaches 1e-4932, so that logarithms of values that are 0
// as a double can be taken as they are.
struct Reference {
  Real value, complement;
};

Reference reference(SigmoidFamily family, Real z) {
  switch (family) {
    case SigmoidFamily::Logistic:
      return {1 / (1 + std::exp(-z)), 1 / (1 + std::exp(z))};
    case SigmoidFamily::Normal:
      return {std::erfc(-z / std::sqrt(Real(2))) / 2, std::erfc(z / std::sqrt(Real(2))) / 2};
    case SigmoidFamily::Weibull:
    case SigmoidFamily::Gumbel:
      return {-std::expm1(-std::exp(z)), std::exp(-std::exp(z))};
    case SigmoidFamily::ReversedGumbel:
      return {std::exp(-std::exp(-z)), -std::expm1(-std::exp(-z))};
    case SigmoidFamily::HyperbolicSecant:
      return {2 / kPi * std::atan(std::exp(kPi / 2 * z)), 2 / kPi * std::atan(std::exp(-kPi / 2 * z))};
    case SigmoidFamily::StudentT:
      return {std::atan2(Real(1), -z) / kPi, std::atan2(Real(1), z) / kPi};
  }
  return {};
}

// ln of a number of which the distance to 1 is known as well.
Real logOf(Real value, Real complement) { return value < 0.5L ? std::log(value) : std::log1p(-complement); }

void expectRelative(double found, Real expected, double tolerance, const std::string& what) {
  if (std::abs(expected) < kSmallestNormal) {  // what cannot be told any more has to vanish
    EXPECT_LE(std::abs(found), 2 * kSmallestNormal) << what;
    return;
  }
  EXPECT_LE(std::abs(static_cast<Real>(found) - expected), tolerance * std::abs(expected)) << what;
}

const double kExtremes[] = {-700, -300, -120, -60,   -37, -36.5, -20,  -10.001, -10,    -9.999, -6,
                            -3,   -1,   -0.1, -1e-3, 0,   1e-6,  1e-3, 0.1,     0.3665, 0.5,    1,
                            3,    6,    6.5,  9,     10,  20,    37,   60,      120,    300,    700};

TEST(Sigmoid, ValuesAndLogarithmsKeepTwelveDigitsInBothTails) {
  for (SigmoidFamily family : kFamilies) {
    for (double z : kExtremes) {
      const std::string what = nameOf(family) + " at z = " + std::to_string(z);
      const Reference r = reference(family, z);
      expectRelative(standardValue(family, z), r.value, 1e-12, "value of " + what);
      expectRelative(standardComplement(family, z), r.complement, 1e-12, "complement of " + what);
      // e^700 and the like: beyond the wider type too, but exactly known.
      const bool gumbel = family == SigmoidFamily::Gumbel || family == SigmoidFamily::Weibull;
      const bool reversed = family == SigmoidFamily::ReversedGumbel;
      const Real logValue = reversed ? -std::exp(-Real(z)) : logOf(r.value, r.complement);
      const Real logComplement = gumbel ? -std::exp(Real(z)) : logOf(r.complement, r.value);
      expectRelative(standardLogValue(family, z), logValue, 1e-12, "ln value of " + what);
      expectRelative(standardLogComplement(family, z), logComplement, 1e-12, "ln complement of " + what);
    }
  }
}

TEST(Sigmoid, InfiniteArgumentsGiveTheLimits) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (SigmoidFamily family : kFamilies) {
    EXPECT_EQ(standardValue(family, -infinity), 0.0) << nameOf(family);
    EXPECT_EQ(standardValue(family, infinity), 1.0) << nameOf(family);
    EXPECT_EQ(standardComplement(family, infinity), 0.0) << nameOf(family);
    EXPECT_EQ(standardLogValue(family, -infinity), -infinity) << nameOf(family);
    EXPECT_EQ(standardLogValue(family, infinity), 0.0) << nameOf(family);
    EXPECT_EQ(standardLogComplement(family, infinity), -infinity) << nameOf(family);
    EXPECT_EQ(standardDerivative(family, infinity), 0.0) << nameOf(family);
    EXPECT_EQ(standardDerivative(family, -infinity), 0.0) << nameOf(family);
    EXPECT_EQ(standardInverse(family, 0.0), -infinity) << nameOf(family);
    EXPECT_EQ(standardInverse(family, 1.0), infinity) << nameOf(family);
  }
}

TEST(Sigmoid, DerivativeIsTheLimitOfDifferences) {
  // Central difference in the wider type: error h^2/6 S''' + 1e-19/h, both below 1e-11 of the slope here.
  const Real h = 1e-6L;
  for (SigmoidFamily family : kFamilies) {
    for (double z : {-3.0, -1.0, -0.2, 0.0, 0.7, 1.5, 3.0}) {
      // Of the smaller of S and 1 - S: the other has lost the digits.
      const Reference low = reference(family, z - h), high = reference(family, z + h);
      const Real difference =
          (low.value < 0.5L ? high.value - low.value : low.complement - high.complement) / (2 * h);
      expectRelative(standardDerivative(family, z), difference, 1e-9, nameOf(family));
    }
  }
}

TEST(Sigmoid, InverseUndoesValueAndComplement) {
  for (SigmoidFamily family : kFamilies) {
    for (double p : {1e-300, 1e-100, 1e-12, 0.001, 0.05, 0.3, 0.5, 0.6, 0.95, 0.999}) {
      expectRelative(standardValue(family, standardInverse(family, p)), p, 1e-12 * (1 - std::log10(p)),
                     nameOf(family) + " value at the inverse");
      expectRelative(standardComplement(family, standardInverseComplement(family, p)), p,
                     1e-12 * (1 - std::log10(p)), nameOf(family) + " complement at the inverse");
    }
  }
}

TEST(Sigmoid, NormalQuantilesAreTheTabulated) {
  // Abramowitz and Stegun, table 26.5 and 26.6.
  EXPECT_NEAR(standardInverse(SigmoidFamily::Normal, 0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(standardInverse(SigmoidFamily::Normal, 0.75), 0.674489750196082, 1e-14);
  EXPECT_NEAR(standardInverse(SigmoidFamily::Normal, 0.999), 3.090232306167813, 1e-13);
}

TEST(Sigmoid, ThresholdAndWidthAreWhatTheyAreCalled) {
  for (SigmoidFamily family : kFamilies) {
    for (StimulusAxis axis : {StimulusAxis::Linear, StimulusAxis::Logarithmic}) {
      const Sigmoid s = Sigmoid::fromThresholdWidth(family, axis, 2.5, 0.8);
      EXPECT_NEAR(s.value(2.5), 0.5, 1e-14) << nameOf(family);
      EXPECT_NEAR(s.width(), 0.8, 1e-13) << nameOf(family);
      const bool logarithmic = s.axis() == StimulusAxis::Logarithmic;
      const double low = s.inverse(0.05), high = s.inverse(0.95);
      EXPECT_NEAR(logarithmic ? std::log(high / low) : high - low, 0.8, 1e-13) << nameOf(family);
      EXPECT_NEAR(s.value(high), 0.95, 1e-14);
      const Sigmoid at75 = Sigmoid::fromThresholdWidth(family, axis, 2.5, 0.8, 0.75);
      EXPECT_NEAR(at75.value(2.5), 0.75, 1e-14) << nameOf(family);
      EXPECT_NEAR(at75.threshold(0.75), 2.5, 1e-14);
      const Sigmoid sloped = Sigmoid::fromThresholdSlope(family, axis, 2.5, 0.4, 0.6);
      EXPECT_NEAR(sloped.value(2.5), 0.6, 1e-14) << nameOf(family);
      EXPECT_NEAR((sloped.value(2.5 + 1e-5) - sloped.value(2.5 - 1e-5)) / 2e-5, 0.4, 1e-8) << nameOf(family);
      EXPECT_NEAR(sloped.slopeAtThreshold(0.6), 0.4, 1e-12) << nameOf(family);
    }
  }
}

TEST(Sigmoid, ClassicFormsAreTheirFormulas) {
  const Sigmoid weibull = Sigmoid::weibull(0.3, 2.2);
  const Sigmoid log10 = Sigmoid::weibullLog10(-0.7, 3.5);
  const Sigmoid decibel = Sigmoid::weibullDecibel(-20, 3.5);
  const Sigmoid logistic = Sigmoid::logistic(1.5, 4);
  for (double x : {0.01, 0.2, 0.3, 0.9}) {
    EXPECT_NEAR(weibull.value(x), 1 - std::exp(-std::pow(x / 0.3, 2.2)), 1e-14);
    EXPECT_NEAR(log10.value(x - 1), 1 - std::exp(-std::pow(10, 3.5 * (x - 0.3))), 1e-14);
    EXPECT_NEAR(decibel.value(20 * x - 30), 1 - std::exp(-std::pow(10, 3.5 * (20 * x - 10) / 20)), 1e-14);
    EXPECT_NEAR(logistic.value(x), 1 / (1 + std::exp(-4 * (x - 1.5))), 1e-14);
  }
  EXPECT_NEAR(weibull.alpha(), 0.3, 1e-15);
  EXPECT_NEAR(weibull.beta(), 2.2, 1e-14);
  EXPECT_NEAR(Sigmoid::normal(1, 2).value(3), 0.841344746068543, 1e-14);  // Phi(1)
  // The slope of a Weibull at its alpha: beta / (e alpha).
  EXPECT_NEAR(weibull.derivative(0.3), 2.2 / (std::numbers::e * 0.3), 1e-13);
}

TEST(Sigmoid, NothingIsSeenAtOrBelowTheEndOfALogarithmicAxis) {
  const Sigmoid s = Sigmoid::weibull(0.3, 2.2);
  EXPECT_EQ(s.value(0.0), 0.0);
  EXPECT_EQ(s.value(-1.0), 0.0);
  EXPECT_EQ(s.complement(0.0), 1.0);
  EXPECT_EQ(s.derivative(0.0), 0.0);
  EXPECT_EQ(s.logComplement(0.0), 0.0);
}

TEST(Sigmoid, UnknownNamesAreRefusedWithTheNearest) {
  for (SigmoidFamily family : kFamilies) EXPECT_EQ(sigmoidFamily(nameOf(family)), family);
  try {
    sigmoidFamily("logistik", "fit.sigmoid");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'logistic'"), std::string::npos) << error.what();
    EXPECT_EQ(error.where(), "fit.sigmoid");
  }
}

}  // namespace
}  // namespace limen::psychometrics
