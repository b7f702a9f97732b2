// SPDX-License-Identifier: BSD-3-Clause
// The part of rank_correlation.h that counts pairs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/statistics/detail/check.h"
#include "analysis/statistics/detail/ranks.h"
#include "analysis/statistics/distributions.h"
#include "analysis/statistics/rank_correlation.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

constexpr size_t kExactKendall = 50;

Coefficient withWald(double value, double error, double level) {
  const Interval interval = around(value, criticalZ(level) * error);
  return {value, error, Interval{std::max(interval.low, -1.0), std::min(interval.high, 1.0)}};
}

/// Of each observation, how many others have a smaller x and a smaller y. In O(n log n).
std::vector<int64_t> countBelow(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<size_t> byX(x.size()), place(x.size());
  std::iota(byX.begin(), byX.end(), size_t{0});
  std::vector<double> values = y;
  std::sort(values.begin(), values.end());
  for (size_t i = 0; i < y.size(); ++i)  // among the values of y, from 0
    place[i] = static_cast<size_t>(std::lower_bound(values.begin(), values.end(), y[i]) - values.begin());
  std::sort(byX.begin(), byX.end(), [&](size_t a, size_t b) { return x[a] < x[b]; });
  // Binary indexed tree (Fenwick 1994) of the places of those with a smaller x.
  std::vector<int64_t> tree(x.size() + 1, 0), out(x.size());
  for (size_t begin = 0, end = 0; begin < x.size(); begin = end) {
    for (; end < x.size() && x[byX[end]] == x[byX[begin]]; ++end)
      for (size_t i = place[byX[end]]; i > 0; i -= i & (~i + 1)) out[byX[end]] += tree[i];
    for (size_t same = begin; same < end; ++same)
      for (size_t i = place[byX[same]] + 1; i < tree.size(); i += i & (~i + 1)) ++tree[i];
  }
  return out;
}

struct Pairs {
  /// Of each observation, how many others it is concordant with less those it is discordant with; the sum is
  /// 2 (P - Q).
  std::vector<double> surplus;
  int64_t concordant = 0, discordant = 0;
};

Pairs countPairs(const std::vector<double>& x, const std::vector<double>& y) {
  const auto negative = [](std::vector<double> values) {
    for (double& value : values) value = -value;
    return values;
  };
  const std::vector<double> minusX = negative(x), minusY = negative(y);
  const std::vector<int64_t> both = countBelow(x, y), none = countBelow(minusX, minusY),
                             onlyX = countBelow(x, minusY), onlyY = countBelow(minusX, y);
  Pairs pairs;
  for (size_t i = 0; i < x.size(); ++i) {
    pairs.surplus.push_back(static_cast<double>(both[i] + none[i] - onlyX[i] - onlyY[i]));
    pairs.concordant += both[i];
    pairs.discordant += onlyX[i];
  }
  return pairs;
}

/// P(|P - Q| >= |s|) over all orders without ties, by the recurrence of the numbers of inversions (Kendall
/// 1970).
double exactKendall(size_t n, int64_t s) {
  const size_t pairs = n * (n - 1) / 2;
  std::vector<double> chance(pairs + 1, 0.0), next(pairs + 1);
  chance[0] = 1.0;
  for (size_t i = 2; i <= n; ++i) {
    const size_t reach = i * (i - 1) / 2;
    for (size_t q = 0; q <= reach; ++q) {
      double sum = 0.0;
      for (size_t k = 0; k < i && k <= q; ++k) sum += chance[q - k];
      next[q] = sum / static_cast<double>(i);
    }
    chance.swap(next);
  }
  // P - Q = pairs - 2 Q.
  const size_t tail = (pairs - static_cast<size_t>(std::abs(s))) / 2;
  double p = 0.0;
  for (size_t q = 0; q <= tail; ++q) p += chance[q];
  return std::min(1.0, 2.0 * p);
}

struct TieSums {
  double pairs = 0.0, triples = 0.0, variance = 0.0;  ///< t(t-1), t(t-1)(t-2), t(t-1)(2t+5)
};

TieSums sumTies(const std::vector<double>& sizes) {
  TieSums sums;
  for (const double t : sizes) {
    sums.pairs += t * (t - 1.0);
    sums.triples += t * (t - 1.0) * (t - 2.0);
    sums.variance += t * (t - 1.0) * (2.0 * t + 5.0);
  }
  return sums;
}

double normalKendall(double n, double s, const TieSums& x, const TieSums& y) {
  double variance = (n * (n - 1.0) * (2.0 * n + 5.0) - x.variance - y.variance) / 18.0 +
                    x.pairs * y.pairs / (2.0 * n * (n - 1.0));
  if (n > 2.0) variance += x.triples * y.triples / (9.0 * n * (n - 1.0) * (n - 2.0));
  return variance > 0.0 ? normalTwoSided(s / std::sqrt(variance)) : 1.0;
}

}  // namespace

Kendall kendall(const std::vector<double>& x, const std::vector<double>& y, double level) {
  requireSample(x, "x", y, "y", level);
  const Ranks ranksX = rank(x), ranksY = rank(y);
  const Pairs pairs = countPairs(x, y);
  const TieSums tiesX = sumTies(ranksX.tieSizes), tiesY = sumTies(ranksY.tieSizes);
  Kendall k;
  k.n = x.size();
  k.concordant = pairs.concordant;
  k.discordant = pairs.discordant;
  k.tiedX = static_cast<int64_t>(tiesX.pairs / 2.0);
  k.tiedY = static_cast<int64_t>(tiesY.pairs / 2.0);
  k.distinctX = ranksX.tieSizes.size();
  k.distinctY = ranksY.tieSizes.size();

  const auto n = static_cast<double>(k.n), s = static_cast<double>(k.concordant - k.discordant);
  double squares = 0.0;
  for (const double surplus : pairs.surplus) squares += std::pow(surplus - 2.0 * s / n, 2.0);
  k.tauA.value = 2.0 * s / (n * (n - 1.0));
  if (k.n >= 3) {
    const double variance =
        2.0 / (n * (n - 1.0)) *
        (2.0 * (n - 2.0) / (n * std::pow(n - 1.0, 2.0)) * squares + 1.0 - k.tauA.value * k.tauA.value);
    k.tauA = withWald(k.tauA.value, std::sqrt(std::max(0.0, variance)), level);
  }
  const size_t m = std::min(k.distinctX, k.distinctY);
  if (m >= 2) {
    const double wr = n * (n - 1.0) - tiesX.pairs, wc = n * (n - 1.0) - tiesY.pairs,
                 w = std::sqrt(wr) * std::sqrt(wc);
    const double tauB = std::clamp(2.0 * s / w, -1.0, 1.0);
    // sum of (2 w d + t v)^2 minus n^3 t^2 (wr + wc)^2, whose mean term is that sum's own mean squared times
    // n.
    std::vector<double> influence(k.n);
    double mean = 0.0;
    for (size_t i = 0; i < k.n; ++i) {
      influence[i] = 2.0 * pairs.surplus[i] / w + tauB * (ranksX.sharing[i] / wr + ranksY.sharing[i] / wc);
      mean += influence[i] / n;
    }
    double spread = 0.0;
    for (const double v : influence) spread += (v - mean) * (v - mean);
    k.tauB = withWald(tauB, std::sqrt(spread), level);

    const double factor = 2.0 * static_cast<double>(m) / (n * n * (static_cast<double>(m) - 1.0));
    k.tauC = withWald(factor * s, factor * std::sqrt(squares), level);
    k.exact = k.distinctX == k.n && k.distinctY == k.n && k.n <= kExactKendall;
    k.p = k.exact ? exactKendall(k.n, k.concordant - k.discordant) : normalKendall(n, s, tiesX, tiesY);
  }
  return k;
}

double stuartTauC(int64_t n, int64_t m, int64_t concordantMinusDiscordant) {
  if (n < 2) throw Error(fmt::format("{} values, needs at least 2", n), "n");
  if (m < 2 || m > n) throw Error(fmt::format("{} distinct values of {}, give 2 to {}", m, n, n), "m");
  const auto dn = static_cast<double>(n), dm = static_cast<double>(m),
             s = static_cast<double>(concordantMinusDiscordant);
  if (std::abs(s) > dn * (dn - 1.0) / 2.0)
    throw Error(fmt::format("{} is more than the pairs of {} values", concordantMinusDiscordant, n), "P - Q");
  return 2.0 * dm * s / (dn * dn * (dm - 1.0));
}

}  // namespace limen::analysis
