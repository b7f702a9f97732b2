// SPDX-License-Identifier: BSD-3-Clause
#include "study/presentation/swap_timer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace limen::study {
namespace {

/// The period is searched within this share of the expected one.
constexpr double kSearch = 0.05;
/// The grid is found on this many swaps, then tracked: the search's cost is quadratic.
constexpr size_t kSearched = 512;
/// Times that lie this well on a grid (mean resultant length) belong to vertical blanks. Uniformly spread
/// ones reach 0.23 with 60 swaps in one of 20 runs; jitter of a tenth of a period gives 0.82.
constexpr double kLeastFit = 0.5;
/// Share of a swap's deviation that shifts the grid: a slow correction of the period found.
constexpr double kFollow = 0.1;
/// Least squares excludes swaps farther than this from the grid, in periods.
constexpr double kTrim = 0.3;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Grid {
  double periodMs = 0.0, originMs = 0.0, fit = 0.0;
};

/// How well times lie on a grid of this period, 0 to 1, and where its blanks are.
Grid gridOf(const std::vector<double>& timesMs, size_t count, double periodMs) {
  double x = 0.0, y = 0.0;
  for (size_t i = 0; i < count; ++i) {
    const double turn = 2.0 * std::numbers::pi * timesMs[i] / periodMs;
    x += std::cos(turn);
    y += std::sin(turn);
  }
  const auto n = static_cast<double>(count);
  return {periodMs, std::atan2(y, x) / (2.0 * std::numbers::pi) * periodMs, std::hypot(x, y) / n};
}

Grid findGrid(const std::vector<double>& timesMs, double expectedMs) {
  const size_t count = std::min(timesMs.size(), kSearched);
  const double span = timesMs[count - 1] - timesMs[0];
  // A step turns the last time by an eighth of a period against the first: no peak lies between two steps.
  const double step = 0.125 * expectedMs * expectedMs / std::max(span, expectedMs);
  Grid best;
  const auto look = [&](double periodMs) {
    const Grid grid = gridOf(timesMs, count, periodMs);
    if (grid.fit > best.fit) best = grid;
  };
  for (double p = expectedMs * (1.0 - kSearch); p <= expectedMs * (1.0 + kSearch); p += step) look(p);
  for (double finer = step / 2; finer > 1e-4 * step; finer /= 2) {
    const double middle = best.periodMs;
    look(middle - finer);
    look(middle + finer);
  }
  return best;
}

/// Numbers of the blanks nearest to each time, following the grid from the first swap to the last.
std::vector<double> nearestBlanks(const std::vector<double>& timesMs, const Grid& grid) {
  std::vector<double> out;
  double blankMs = grid.originMs, number = 0.0;
  blankMs += grid.periodMs * std::round((timesMs[0] - blankMs) / grid.periodMs);
  for (const double time : timesMs) {
    const double passed = std::round((time - blankMs) / grid.periodMs);
    number += passed;
    blankMs += passed * grid.periodMs;
    blankMs += kFollow * (time - blankMs);
    out.push_back(number);
  }
  return out;
}

/// Least squares of time over number, with outliers excluded in a second round.
Grid fitGrid(const std::vector<double>& timesMs, const std::vector<double>& numbers, Grid grid) {
  for (int round = 0; round < 3; ++round) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (size_t i = 0; i < timesMs.size(); ++i) {
      const double error = (timesMs[i] - grid.originMs) / grid.periodMs - numbers[i];
      if (round > 0 && std::abs(error) > kTrim) continue;
      n += 1, sx += numbers[i], sy += timesMs[i];
      sxx += numbers[i] * numbers[i], sxy += numbers[i] * timesMs[i];
    }
    const double determinant = n * sxx - sx * sx;
    if (!(determinant > 0.0)) break;
    grid.periodMs = (n * sxy - sx * sy) / determinant;
    grid.originMs = (sy - grid.periodMs * sx) / n;
  }
  return grid;
}

/// The period according to the median interval: the nominal one if the interval is a multiple of it, as when
/// every frame takes two blanks; otherwise the interval, and the nominal rate is wrong. None: no waiting.
std::optional<double> expectedPeriodMs(const std::vector<double>& timesMs, double nominalMs) {
  std::vector<double> intervals;
  for (size_t i = 1; i < timesMs.size(); ++i) intervals.push_back(timesMs[i] - timesMs[i - 1]);
  const double middle = median(std::move(intervals));
  const double blanks = std::round(middle / nominalMs);
  if (blanks >= 1.0 && std::abs(middle / nominalMs - blanks) < kSearch * blanks && blanks <= 8.0)
    return nominalMs;
  // Twice the nominal rate is still a display; ten times is none.
  if (middle < 0.2 * nominalMs) return std::nullopt;
  return middle;
}

void count(SwapReport& report) {
  for (const Swap& swap : report.swaps) {
    report.missedBlanks += swap.missed;
    report.lateSwaps += swap.kind == SwapKind::Late;
    report.earlySwaps += swap.kind == SwapKind::Early;
  }
}

}  // namespace

SwapReport classifySwaps(const std::vector<int64_t>& returnedNs, const SwapSetting& setting) {
  SwapReport out;
  out.swaps.resize(returnedNs.size());
  const double nominalMs = 1000.0 / setting.nominalHz;
  out.periodMs = nominalMs;
  if (returnedNs.size() < 3) return out;
  std::vector<double> timesMs;
  for (const int64_t time : returnedNs) timesMs.push_back(1e-6 * static_cast<double>(time - returnedNs[0]));

  const std::optional<double> expected = expectedPeriodMs(timesMs, nominalMs);
  if (!expected) return out;
  Grid grid = findGrid(timesMs, *expected);
  if (grid.fit < kLeastFit) return out;
  grid = fitGrid(timesMs, nearestBlanks(timesMs, grid), grid);
  out.waits = true;
  out.periodMs = grid.periodMs;

  const size_t n = timesMs.size();
  std::vector<double> at(n), blank(n);
  std::vector<bool> early(n, false);
  for (size_t i = 0; i < n; ++i) at[i] = (timesMs[i] - grid.originMs) / grid.periodMs;
  for (size_t i = n; i-- > 0;) {
    blank[i] = std::floor(at[i] + setting.earlyTolerance);
    if (i + 1 == n || blank[i] < blank[i + 1]) continue;
    // Its blank is the next one's. Either it was noticed late, or the next one did not wait.
    if (at[i] - (blank[i + 1] - 1.0) <= setting.latestRecovery)
      blank[i] = blank[i + 1] - 1.0;
    else
      early[i + 1] = true;
  }
  for (size_t i = 0; i < n; ++i) {
    Swap& swap = out.swaps[i];
    swap.blank = static_cast<int64_t>(blank[i] - blank[0]);
    swap.latenessMs = (at[i] - blank[i]) * grid.periodMs;
    if (i > 0) swap.missed = static_cast<int>(std::max(0.0, blank[i] - blank[i - 1] - 1.0));
    swap.kind = early[i]                                    ? SwapKind::Early
                : swap.missed > 0                           ? SwapKind::Missed
                : at[i] - blank[i] > setting.earlyTolerance ? SwapKind::Late
                                                            : SwapKind::OnTime;
  }
  count(out);
  return out;
}

}  // namespace limen::study
