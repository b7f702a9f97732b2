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

Interval cut(double low, double high) { return {std::clamp(low, -1.0, 1.0), std::clamp(high, -1.0, 1.0)}; }

Coefficient withWald(double value, double error, double level) {
  const double reach = -normalQuantile((1.0 - level) / 2.0) * error;
  return {value, error, cut(value - reach, value + reach)};
}

/// Of each observation, how many others it is concordant with and how many discordant.
struct Pairs {
  std::vector<int64_t> concordant, discordant;
};

Pairs countPairs(const std::vector<double>& x, const Ranks& ranksY) {
  const size_t n = x.size();
  // Dense ranks of y: index of the group of ties.
  std::vector<size_t> byX(n), group(n), byY(n);
  std::iota(byX.begin(), byX.end(), size_t{0});
  byY = byX;
  std::sort(byY.begin(), byY.end(), [&](size_t a, size_t b) { return ranksY.ranks[a] < ranksY.ranks[b]; });
  for (size_t i = 1; i < n; ++i)
    group[byY[i]] = group[byY[i - 1]] + (ranksY.ranks[byY[i]] != ranksY.ranks[byY[i - 1]] ? 1 : 0);
  std::sort(byX.begin(), byX.end(), [&](size_t a, size_t b) { return x[a] < x[b]; });

  const size_t groups = ranksY.tieSizes.size();
  std::vector<int64_t> tree(groups + 1, 0), smaller(groups + 1, 0);
  for (size_t g = 0; g < groups; ++g) smaller[g + 1] = smaller[g] + static_cast<int64_t>(ranksY.tieSizes[g]);
  const auto add = [&](size_t g) {
    for (size_t i = g + 1; i <= groups; i += i & (~i + 1)) ++tree[i];
  };
  const auto below = [&](size_t g) {  // how many were added in groups before g
    int64_t sum = 0;
    for (size_t i = g; i > 0; i -= i & (~i + 1)) sum += tree[i];
    return sum;
  };

  Pairs pairs{std::vector<int64_t>(n, 0), std::vector<int64_t>(n, 0)};
  int64_t before = 0;
  for (size_t begin = 0; begin < n;) {
    size_t end = begin;
    while (end < n && x[byX[end]] == x[byX[begin]]) ++end;
    std::vector<size_t> block(byX.begin() + static_cast<std::ptrdiff_t>(begin),
                              byX.begin() + static_cast<std::ptrdiff_t>(end));
    std::sort(block.begin(), block.end(), [&](size_t a, size_t b) { return group[a] < group[b]; });
    for (size_t i = 0; i < block.size();) {
      const size_t g = group[block[i]];
      size_t j = i;
      while (j < block.size() && group[block[j]] == g) ++j;
      const int64_t lowBelow = below(g), lowAbove = before - below(g + 1);
      // Those of larger x are all that are neither of smaller nor of equal x.
      const int64_t highBelow = smaller[g] - lowBelow - static_cast<int64_t>(i);
      const int64_t highAbove =
          static_cast<int64_t>(n) - smaller[g + 1] - lowAbove - static_cast<int64_t>(block.size() - j);
      for (size_t k = i; k < j; ++k) {
        pairs.concordant[block[k]] = lowBelow + highAbove;
        pairs.discordant[block[k]] = lowAbove + highBelow;
      }
      i = j;
    }
    for (const size_t i : block) add(group[i]);
    before += static_cast<int64_t>(block.size());
    begin = end;
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

/// Of each observation, how many share its value, itself included.
std::vector<double> ownTieSizes(const Ranks& ranks) {
  std::vector<double> midranks, sizes;
  double before = 0.0;
  for (const double size : ranks.tieSizes) {
    midranks.push_back(before + 0.5 * (size + 1.0));
    before += size;
  }
  for (const double own : ranks.ranks) {
    const auto at = std::lower_bound(midranks.begin(), midranks.end(), own);
    sizes.push_back(ranks.tieSizes[static_cast<size_t>(at - midranks.begin())]);
  }
  return sizes;
}

}  // namespace

Kendall kendall(const std::vector<double>& x, const std::vector<double>& y, double level) {
  requireSample(x, "x", y, "y", level);
  const Ranks ranksX = rank(x), ranksY = rank(y);
  const Pairs pairs = countPairs(x, ranksY);
  const TieSums tiesX = sumTies(ranksX.tieSizes), tiesY = sumTies(ranksY.tieSizes);
  Kendall k;
  k.n = x.size();
  k.concordant = std::accumulate(pairs.concordant.begin(), pairs.concordant.end(), int64_t{0}) / 2;
  k.discordant = std::accumulate(pairs.discordant.begin(), pairs.discordant.end(), int64_t{0}) / 2;
  k.tiedX = static_cast<int64_t>(tiesX.pairs / 2.0);
  k.tiedY = static_cast<int64_t>(tiesY.pairs / 2.0);
  k.distinctX = ranksX.tieSizes.size();
  k.distinctY = ranksY.tieSizes.size();

  const auto n = static_cast<double>(k.n), s = static_cast<double>(k.concordant - k.discordant);
  std::vector<double> surplus(k.n);  // d_i = C_i - D_i; their sum is 2 s
  double squares = 0.0;
  for (size_t i = 0; i < k.n; ++i) {
    surplus[i] = static_cast<double>(pairs.concordant[i] - pairs.discordant[i]);
    squares += std::pow(surplus[i] - 2.0 * s / n, 2.0);
  }
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
    const std::vector<double> sizeX = ownTieSizes(ranksX), sizeY = ownTieSizes(ranksY);
    std::vector<double> influence(k.n);
    double mean = 0.0;
    for (size_t i = 0; i < k.n; ++i) {
      influence[i] = 2.0 * surplus[i] / w + tauB * (sizeX[i] / wr + sizeY[i] / wc);
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
