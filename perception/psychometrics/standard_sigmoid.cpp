// SPDX-License-Identifier: BSD-3-Clause
#include "perception/psychometrics/standard_sigmoid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::psychometrics {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHalfLogTwoPi = 0.91893853320467274178;  // ln(2 pi) / 2

// --- Logistic

double logisticValue(double z) {
  if (z >= 0.0) return 1.0 / (1.0 + std::exp(-z));
  const double e = std::exp(z);
  return e / (1.0 + e);
}

double logisticLogValue(double z) {
  return z >= 0.0 ? -std::log1p(std::exp(-z)) : z - std::log1p(std::exp(z));
}

// --- Normal

double normalValue(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

// ln of Q(t)/phi(t) t by the asymptotic series of Mills' ratio (Abramowitz and Stegun 26.2.12); at t >= 10
// its terms fall below 1e-16 before they grow again.
double logMillsTimesT(double t) {
  const double inverse = 1.0 / (t * t);
  double term = 1.0, sum = 0.0;
  for (int k = 1; k < 40; ++k) {
    term *= -(2.0 * k - 1.0) * inverse;
    sum += term;
    if (std::abs(term) < 1e-18) break;
  }
  return std::log1p(sum);
}

double normalLogValue(double z) {
  if (z == -kInfinity) return -kInfinity;
  if (z < -10.0) return -0.5 * z * z - kHalfLogTwoPi - std::log(-z) + logMillsTimesT(-z);
  return z < 0.0 ? std::log(normalValue(z)) : std::log1p(-normalValue(-z));
}

// The z <= 0 with ln Phi(z) = logP. ln Phi is concave and grows, so that every Newton step ends left of the
// root or on it, and the steps from there climb to it.
double normalInverseOfLog(double logP) {
  if (logP == -kInfinity) return -kInfinity;
  // Abramowitz and Stegun 26.2.23, off by 4.5e-4 at most.
  const double t = std::sqrt(-2.0 * logP);
  double z = -(t - (2.515517 + t * (0.802853 + t * 0.010328)) /
                       (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308))));
  for (int i = 0; i < 8; ++i) {
    const double logValue = normalLogValue(z);
    const double slope = std::exp(-0.5 * z * z - kHalfLogTwoPi - logValue);
    const double step = (logP - logValue) / slope;
    z += step;
    if (std::abs(step) <= 1e-15 * std::max(1.0, std::abs(z))) break;
  }
  return z;
}

// --- Gumbel; w = exp(z)

double gumbelValue(double z) { return -std::expm1(-std::exp(z)); }
double gumbelComplement(double z) { return std::exp(-std::exp(z)); }
double gumbelLogComplement(double z) { return -std::exp(z); }

double gumbelLogValue(double z) {
  const double w = std::exp(z);
  // ln((1 - exp(-w)) / w) as a series; w itself may have become 0.
  if (w < 1e-3) return z - w / 2.0 + w * w / 24.0 - w * w * w * w / 2880.0;
  return w < std::numbers::ln2 ? std::log(-std::expm1(-w)) : std::log1p(-std::exp(-w));
}

// --- Hyperbolic secant

double secantValue(double z) {
  if (z > 0.0) return 1.0 - secantValue(-z);
  return 2.0 / kPi * std::atan(std::exp(kPi / 2.0 * z));
}

double secantLogValue(double z) {
  if (z > 0.0) return std::log1p(-secantValue(-z));
  const double exponent = kPi / 2.0 * z;
  const double w = std::exp(exponent);
  if (w < 1e-4) return exponent + std::log(2.0 / kPi) - w * w / 3.0;  // next term: w^4 13/90
  return std::log(2.0 / kPi * std::atan(w));
}

// --- Student's t, one degree of freedom

double studentValue(double z) { return std::atan2(1.0, -z) / kPi; }
double studentLogValue(double z) {
  return z > 0.0 ? std::log1p(-studentValue(-z)) : std::log(studentValue(z));
}

// Inverse for p <= 1/2 of the symmetric families.
double lowerInverse(SigmoidFamily family, double p) {
  if (p == 0.0) return -kInfinity;
  if (p == 0.5) return 0.0;
  switch (family) {
    case SigmoidFamily::Logistic:
      return std::log(p) - std::log1p(-p);
    case SigmoidFamily::Normal:
      return normalInverseOfLog(std::log(p));
    case SigmoidFamily::HyperbolicSecant:
      return 2.0 / kPi * std::log(std::tan(kPi / 2.0 * p));
    case SigmoidFamily::StudentT:
      return -1.0 / std::tan(kPi * p);
    default:
      assert(false);
      return 0.0;
  }
}

}  // namespace

const std::vector<std::string>& sigmoidNames() {
  // In the order of the enumeration.
  static const std::vector<std::string> kNames = {
      "logistic", "normal", "weibull", "gumbel", "reversed_gumbel", "hyperbolic_secant", "student_t"};
  return kNames;
}

const std::string& nameOf(SigmoidFamily family) { return sigmoidNames()[static_cast<size_t>(family)]; }

SigmoidFamily sigmoidFamily(const std::string& name, const std::string& where) {
  const std::vector<std::string>& names = sigmoidNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw Error("no sigmoid '" + name + "'", where, suggest(name, names));
  return static_cast<SigmoidFamily>(found - names.begin());
}

double standardValue(SigmoidFamily family, double z) {
  switch (family) {
    case SigmoidFamily::Logistic:
      return logisticValue(z);
    case SigmoidFamily::Normal:
      return normalValue(z);
    case SigmoidFamily::Weibull:
    case SigmoidFamily::Gumbel:
      return gumbelValue(z);
    case SigmoidFamily::ReversedGumbel:
      return gumbelComplement(-z);
    case SigmoidFamily::HyperbolicSecant:
      return secantValue(z);
    case SigmoidFamily::StudentT:
      return studentValue(z);
  }
  return 0.0;
}

double standardComplement(SigmoidFamily family, double z) {
  switch (family) {
    case SigmoidFamily::Weibull:
    case SigmoidFamily::Gumbel:
      return gumbelComplement(z);
    case SigmoidFamily::ReversedGumbel:
      return gumbelValue(-z);
    default:
      return standardValue(family, -z);
  }
}

double standardLogValue(SigmoidFamily family, double z) {
  switch (family) {
    case SigmoidFamily::Logistic:
      return logisticLogValue(z);
    case SigmoidFamily::Normal:
      return normalLogValue(z);
    case SigmoidFamily::Weibull:
    case SigmoidFamily::Gumbel:
      return gumbelLogValue(z);
    case SigmoidFamily::ReversedGumbel:
      return gumbelLogComplement(-z);
    case SigmoidFamily::HyperbolicSecant:
      return secantLogValue(z);
    case SigmoidFamily::StudentT:
      return studentLogValue(z);
  }
  return 0.0;
}

double standardLogComplement(SigmoidFamily family, double z) {
  switch (family) {
    case SigmoidFamily::Weibull:
    case SigmoidFamily::Gumbel:
      return gumbelLogComplement(z);
    case SigmoidFamily::ReversedGumbel:
      return gumbelLogValue(-z);
    default:
      return standardLogValue(family, -z);
  }
}

double standardDerivative(SigmoidFamily family, double z) {
  switch (family) {
    case SigmoidFamily::Logistic:
      return logisticValue(z) * logisticValue(-z);
    case SigmoidFamily::Normal:
      return std::exp(-0.5 * z * z - kHalfLogTwoPi);
    case SigmoidFamily::Weibull:
    case SigmoidFamily::Gumbel:
      return z == kInfinity ? 0.0 : std::exp(z - std::exp(z));
    case SigmoidFamily::ReversedGumbel:
      return z == -kInfinity ? 0.0 : std::exp(-z - std::exp(-z));
    case SigmoidFamily::HyperbolicSecant:
      return 0.5 / std::cosh(kPi / 2.0 * z);
    case SigmoidFamily::StudentT:
      return 1.0 / (kPi * (1.0 + z * z));
  }
  return 0.0;
}

double standardInverse(SigmoidFamily family, double p) {
  assert(p >= 0.0 && p <= 1.0);
  switch (family) {
    case SigmoidFamily::Weibull:
    case SigmoidFamily::Gumbel:
      return std::log(-std::log1p(-p));
    case SigmoidFamily::ReversedGumbel:
      return -std::log(-std::log(p));
    default:
      return p <= 0.5 ? lowerInverse(family, p) : -lowerInverse(family, 1.0 - p);
  }
}

double standardInverseComplement(SigmoidFamily family, double q) {
  assert(q >= 0.0 && q <= 1.0);
  switch (family) {
    case SigmoidFamily::Weibull:
    case SigmoidFamily::Gumbel:
      return std::log(-std::log(q));
    case SigmoidFamily::ReversedGumbel:
      return -std::log(-std::log1p(-q));
    default:
      return -standardInverse(family, q);
  }
}

}  // namespace limen::psychometrics
