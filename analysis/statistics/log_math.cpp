// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/log_math.h"

#include <algorithm>
#include <array>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>

namespace limen::analysis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHalfLogTwoPi = 0.91893853320467274178;

/// Stirling's series of ln Gamma(x) - (x - 1/2) ln x + x - ln(2 pi)/2 (Abramowitz and Stegun 6.1.41); at
/// x >= 15 the first term left out is below 1e-17.
double stirlingSeries(double x) {
  const double s = 1.0 / (x * x);
  return (1.0 / 12.0 -
          s * (1.0 / 360.0 -
               s * (1.0 / 1260.0 - s * (1.0 / 1680.0 - s * (1.0 / 1188.0 - s * (691.0 / 360360.0)))))) /
         x;
}

/// Sum over i < n of 1/(x + i) = psi(x + n) - psi(x) by the asymptotic series of psi (6.3.18), x >= 15.
double harmonicSum(double x, double n) {
  const auto tail = [](double y) {
    const double s = 1.0 / (y * y);
    return 0.5 / y + s * (1.0 / 12.0 - s * (1.0 / 120.0 - s * (1.0 / 252.0 - s * (1.0 / 240.0 - s / 132.0))));
  };
  return std::log1p(n / x) - tail(x + n) + tail(x);
}

/// (1 + t) ln(1 + t) - t >= 0, t >= 0.
double excess(double t) {
  if (t > 0.1) return (1.0 + t) * std::log1p(t) - t;
  double sum = 0.0, power = t;
  for (int m = 2; m < 20; ++m) {
    power *= t;
    sum += (m % 2 ? -power : power) / (m * (m - 1.0));
  }
  return sum;
}

}  // namespace

double logAddExp(double a, double b) {
  const double high = std::max(a, b), low = std::min(a, b);
  if (low == -kInfinity || high == kInfinity) return high;
  return high + std::log1p(std::exp(low - high));
}

double halfDeviance(double x, double m, double logM) {
  if (x == 0.0) return m;
  if (std::abs(x - m) < 0.1 * (x + m)) {
    // With v = (x - m)/(x + m): x ln(x/m) = 2 x (v + v^3/3 + ...), and m - x = -v (x + m).
    const double v = (x - m) / (x + m);
    double sum = (x - m) * v, term = 2.0 * x * v;
    for (int j = 1; j < 60; ++j) {
      term *= v * v;
      const double next = sum + term / (2 * j + 1);
      if (next == sum) return next;
      sum = next;
    }
    return sum;
  }
  return x * (std::log(x) - logM) + m - x;
}

double stirlingError(double n) {
  // Below 16 by ln n! itself; the values of n = 0 ... 15 are few.
  static const std::array<double, 16> kSmall = [] {
    std::array<double, 16> table{};
    for (int i = 1; i < 16; ++i) {
      const long double k = i;
      table[static_cast<size_t>(i)] = static_cast<double>(
          boost::math::lgamma(k + 1) - (k + 0.5L) * std::log(k) + k - 0.918938533204672741780329736406L);
    }
    return table;
  }();
  if (n < 16.0) return kSmall[static_cast<size_t>(n)];
  return stirlingSeries(n);
}

double logSaturatedChance(int64_t k, int64_t n) {
  if (k == 0 || k == n) return 0.0;
  const double a = static_cast<double>(k), b = static_cast<double>(n - k), sum = static_cast<double>(n);
  return stirlingError(sum) - stirlingError(a) - stirlingError(b) - kHalfLogTwoPi -
         0.5 * std::log(a * (b / sum));
}

int64_t binomialAt(double u, int64_t n, double p, double q) {
  if (n == 0 || p <= 0.0) return 0;
  if (q <= 0.0) return n;
  const double dn = static_cast<double>(n);
  const int64_t mode = std::min(n, static_cast<int64_t>(std::floor((dn + 1.0) * p)));
  const double logN = std::log(dn), dm = static_cast<double>(mode);
  const double atMode = std::exp(logSaturatedChance(mode, n) - halfDeviance(dm, dn * p, logN + std::log(p)) -
                                 halfDeviance(dn - dm, dn * q, logN + std::log(q)));
  double left = u - atMode;
  if (left < 0.0) return mode;
  int64_t down = mode, up = mode;
  double chanceDown = atMode, chanceUp = atMode;
  const double odds = p / q;
  while (true) {
    const bool canDown = down > 0 && chanceDown > 0.0, canUp = up < n && chanceUp > 0.0;
    if (!canDown && !canUp) return mode;  // what rounding leaves over
    if (canUp) {
      chanceUp *= odds * static_cast<double>(n - up) / static_cast<double>(up + 1);
      ++up;
      if ((left -= chanceUp) < 0.0) return up;
    }
    if (canDown) {
      chanceDown *= static_cast<double>(down) / (odds * static_cast<double>(n - down + 1));
      --down;
      if ((left -= chanceDown) < 0.0) return down;
    }
  }
}

RisingSum logRisingSum(double p, double r, int64_t k) {
  RisingSum sum;
  // Directly while the terms are few or near the pole of the Gamma function.
  constexpr int64_t kDirect = 48;
  int64_t direct = k;
  if (k > kDirect) direct = p >= 15.0 * r ? 0 : std::min(k, static_cast<int64_t>(std::ceil(15.0 - p / r)));
  double product = 1.0;
  for (int64_t i = 0; i < direct; ++i) {
    const double di = static_cast<double>(i);
    const double term = p + di * r;
    if (p > 0.5 && term < 1.5) {
      // p - 1 is exact: near 1 the logarithm keeps the digits of what is left.
      sum.value += std::log1p((p - 1.0) + di * r);
    } else if (i == 0) {
      // p may be too small for products.
      sum.value += std::log(term);
    } else {
      product *= term;
      if (product < 1e-150 || product > 1e150) {
        sum.value += std::log(product);
        product = 1.0;
      }
    }
    sum.byP += 1.0 / term;
    sum.byR += di / term;
  }
  sum.value += std::log(product);
  if (direct == k) return sum;

  const double start = p + static_cast<double>(direct) * r;  // r x
  const double n = static_cast<double>(k - direct), offset = static_cast<double>(direct);
  if (n * r < 1e-5 * start) {
    // Expanded in r: sums of i^m over 0 ... n - 1. The next term is 1e-20 of the first.
    const double s1 = n * (n - 1.0) / 2.0, s2 = s1 * (2.0 * n - 1.0) / 3.0, s3 = s1 * s1;
    const double e = r / start;
    sum.value += n * std::log(start) + e * s1 - e * e * s2 / 2.0 + e * e * e * s3 / 3.0;
    const double inverse = (n - e * s1 + e * e * s2 - e * e * e * s3) / start;  // sum of 1/term
    sum.byP += inverse;
    sum.byR += offset * inverse + (s1 - e * s2 + e * e * s3) / start;
    return sum;
  }
  const double x = start / r;
  sum.value += n * std::log(start) + x * excess(n / x) - 0.5 * std::log1p(n / x) + stirlingSeries(x + n) -
               stirlingSeries(x);
  const double inverse = harmonicSum(x, n) / r;
  sum.byP += inverse;
  // Sum of (offset + i)/(start + i r), with i r = (start + i r) - start.
  sum.byR += offset * inverse + (n - start * inverse) / r;
  return sum;
}

}  // namespace limen::analysis
