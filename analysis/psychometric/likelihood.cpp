// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/psychometric/likelihood.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/statistics/log_math.h"

namespace limen::analysis {

using psychometrics::SigmoidFamily;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTail = 0.05;

/// ln dS/dz, finite wherever z is.
double logDensity(SigmoidFamily family, double z) {
  switch (family) {
    case SigmoidFamily::Logistic:
      return -std::abs(z) - 2.0 * std::log1p(std::exp(-std::abs(z)));
    case SigmoidFamily::Normal:
      return -0.5 * z * z - 0.91893853320467274178;
    case SigmoidFamily::Weibull:
    case SigmoidFamily::Gumbel:
      return z - std::exp(z);
    case SigmoidFamily::ReversedGumbel:
      return -z - std::exp(-z);
    case SigmoidFamily::HyperbolicSecant: {
      const double t = std::numbers::pi / 2.0 * std::abs(z);
      return -t - std::log1p(std::exp(-2.0 * t));  // -ln(2 cosh t)
    }
    case SigmoidFamily::StudentT:
      return -std::log(std::numbers::pi) -
             (std::abs(z) > 1e8 ? 2.0 * std::log(std::abs(z)) : std::log1p(z * z));
  }
  return 0.0;
}

/// Below this numbers are near enough to underflow for logarithms to be asked.
constexpr double kSmall = 1e-290;

double ratio(double logC, double logP) { return logC == -kInfinity ? 0.0 : std::exp(logC - logP); }

/// F and 1 - F, with logarithms only where they are needed: few callers are in the far tails.
struct Standard {
  double f, complement;
};

Chance chanceOf(const SigmoidShape& shape, double z, const Standard& s, double guess, double lapse) {
  Chance chance{};
  chance.p = guess * s.complement + (1.0 - lapse) * s.f;
  chance.q = (1.0 - guess) * s.complement + lapse * s.f;
  // The nearer to 1 by the other's log1p; where one has underflowed, by the sigmoid's own logarithm.
  const auto logOf = [](double own, double other) { return own < 0.5 ? std::log(own) : std::log1p(-other); };
  chance.logP = chance.p > kSmall ? logOf(chance.p, chance.q)
                                  : logAddExp(std::log(guess) + standardLogComplement(shape.family, z),
                                              std::log1p(-lapse) + standardLogValue(shape.family, z));
  chance.logQ = chance.q > kSmall ? logOf(chance.q, chance.p)
                                  : logAddExp(std::log1p(-guess) + standardLogComplement(shape.family, z),
                                              std::log(lapse) + standardLogValue(shape.family, z));
  return chance;
}

Standard standardAt(const SigmoidShape& shape, double z) {
  return {standardValue(shape.family, z), standardComplement(shape.family, z)};
}

}  // namespace

SigmoidShape::SigmoidShape(const FitSettings& settings)
    : family(settings.sigmoid),
      logarithmic(settings.logarithmic()),
      falling(settings.falling),
      level(settings.thresholdLevel),
      zAtThreshold(standardInverse(settings.sigmoid, settings.thresholdLevel)),
      zWidth(standardInverseComplement(settings.sigmoid, kTail) - standardInverse(settings.sigmoid, kTail)) {}

double SigmoidShape::onAxis(double x) const {
  if (x == kNoStimulus) return -kInfinity;
  const double u = logarithmic ? std::log(x) : x;
  return falling ? -u : u;
}

double SigmoidShape::offAxis(double u) const {
  const double turned = falling ? -u : u;
  return logarithmic ? std::exp(turned) : turned;
}

std::array<double, 2> SigmoidShape::offAxis(double low, double high) const {
  return falling ? std::array{offAxis(high), offAxis(low)} : std::array{offAxis(low), offAxis(high)};
}

double SigmoidShape::z(double u, const AxisValues& values) const {
  return zAtThreshold +
         (u - values[indexOf(FitParameter::Threshold)]) / values[indexOf(FitParameter::Width)] * zWidth;
}

Chance chanceAt(const SigmoidShape& shape, double u, const AxisValues& values) {
  const double z = shape.z(u, values);
  return chanceOf(shape, z, standardAt(shape, z), values[indexOf(FitParameter::Guess)],
                  values[indexOf(FitParameter::Lapse)]);
}

PreparedBlocks::PreparedBlocks(const Condition& condition, const SigmoidShape& shape) {
  for (const Block& block : condition.blocks) {
    if (block.trials == 0) continue;
    u.push_back(shape.onAxis(block.level));
    correct.push_back(block.correct);
    trials.push_back(block.trials);
    order.push_back(block.order);
    logSaturated += logSaturatedChance(block.correct, block.trials);
  }
}

double covariance(const PreparedBlocks& blocks) {
  double meanU = 0.0, meanP = 0.0, sum = 0.0, n = 0.0;
  for (size_t i = 0; i < blocks.u.size(); ++i) {
    if (!std::isfinite(blocks.u[i])) continue;
    n += static_cast<double>(blocks.trials[i]);
    meanU += static_cast<double>(blocks.trials[i]) * blocks.u[i];
    meanP += static_cast<double>(blocks.correct[i]);
  }
  for (size_t i = 0; i < blocks.u.size(); ++i)
    if (std::isfinite(blocks.u[i]))
      sum += (blocks.u[i] - meanU / n) *
             (static_cast<double>(blocks.correct[i]) - static_cast<double>(blocks.trials[i]) * meanP / n);
  return sum;
}

double halfBlockDeviance(const Chance& chance, int64_t correct, int64_t trials) {
  const double n = static_cast<double>(trials), logN = std::log(n);
  return halfDeviance(static_cast<double>(correct), n * chance.p, logN + chance.logP) +
         halfDeviance(static_cast<double>(trials - correct), n * chance.q, logN + chance.logQ);
}

double negativeLogLikelihood(const SigmoidShape& shape, const PreparedBlocks& blocks,
                             const AxisValues& values, AxisValues* gradient) {
  const double width = values[indexOf(FitParameter::Width)], guess = values[indexOf(FitParameter::Guess)],
               lapse = values[indexOf(FitParameter::Lapse)], eta = values[indexOf(FitParameter::Eta)];
  const double r = rho(eta);
  double sum = 0.0;
  AxisValues slope{};
  for (size_t i = 0; i < blocks.u.size(); ++i) {
    const double z = shape.z(blocks.u[i], values);
    const Standard s = standardAt(shape, z);
    const Chance chance = chanceOf(shape, z, s, guess, lapse);
    const int64_t k = blocks.correct[i], n = blocks.trials[i];
    if ((k > 0 && chance.logP == -kInfinity) || (k < n && chance.logQ == -kInfinity)) return kInfinity;
    // d(-ln likelihood) = byP dP - byQ dP, each divided by P or Q so far as binomial.
    double weightP = static_cast<double>(k), weightQ = static_cast<double>(n - k);
    if (r == 0.0) {
      sum += halfBlockDeviance(chance, k, n);
    } else {
      const RisingSum up = logRisingSum(chance.p, r, k), down = logRisingSum(chance.q, r, n - k),
                      all = logRisingSum(1.0, r, n);
      if (!std::isfinite(up.value) || !std::isfinite(down.value)) return kInfinity;
      // ln C(n, k), from the saturated chance: ln C + k ln(k/n) + (n - k) ln((n - k)/n).
      const double dk = static_cast<double>(k), dn = static_cast<double>(n);
      const double saturated =
          (k > 0 ? dk * std::log(dk / dn) : 0.0) + (k < n ? (dn - dk) * std::log((dn - dk) / dn) : 0.0);
      sum += saturated - (up.value + down.value - all.value);
      weightP = k > 0 ? up.byP * chance.p : 0.0;
      weightQ = k < n ? down.byP * chance.q : 0.0;
      const double byEta = 2.0 * eta / ((1.0 - eta * eta) * (1.0 - eta * eta));
      slope[indexOf(FitParameter::Eta)] -= byEta * (up.byR + down.byR - all.byR);
    }
    if (!gradient) continue;
    // Logarithms stand in where something has underflowed.
    const bool extreme = std::min({s.f, s.complement, chance.p, chance.q}) < kSmall;
    const double logF = extreme ? standardLogValue(shape.family, z) : 0.0;
    const double logC = extreme ? standardLogComplement(shape.family, z) : 0.0;
    const double range = 1.0 - guess - lapse;
    const auto perP = [&](double c, double logOf) {
      return k > 0 ? weightP * (extreme ? ratio(logOf, chance.logP) : c / chance.p) : 0.0;
    };
    const auto perQ = [&](double c, double logOf) {
      return k < n ? weightQ * (extreme ? ratio(logOf, chance.logQ) : c / chance.q) : 0.0;
    };
    // A level at minus infinity has F = 0 whatever threshold and width.
    if (std::isfinite(z)) {
      const double density = standardDerivative(shape.family, z);
      const double logD = extreme ? std::log1p(-guess - lapse) + logDensity(shape.family, z) : 0.0;
      const double byZ = perQ(range * density, logD) - perP(range * density, logD);
      slope[indexOf(FitParameter::Threshold)] -= byZ * shape.zWidth / width;
      slope[indexOf(FitParameter::Width)] -= byZ * (z - shape.zAtThreshold) / width;
    }
    // dP/dguess = 1 - F, dP/dlapse = -F.
    slope[indexOf(FitParameter::Guess)] += perQ(s.complement, logC) - perP(s.complement, logC);
    slope[indexOf(FitParameter::Lapse)] += perP(s.f, logF) - perQ(s.f, logF);
  }
  if (gradient)
    for (size_t i = 0; i < kFitParameters; ++i) (*gradient)[i] += slope[i];
  return sum;
}

}  // namespace limen::analysis
