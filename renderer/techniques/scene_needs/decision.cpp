// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/scene_needs/decision.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace limen::techniques {
namespace {

/// Linear interpolation between order statistics (Hyndman and Fan, type 7).
double quantile(const std::vector<double>& sorted, double q) {
  const double at = q * double(sorted.size() - 1);
  const auto below = static_cast<size_t>(at);
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], at - double(below));
}

/// The index of the least value.
template <class Value>
size_t leastBy(const std::vector<size_t>& indices, Value value) {
  return *std::min_element(indices.begin(), indices.end(),
                           [&](size_t a, size_t b) { return value(a) < value(b); });
}

template <class Condition>
std::vector<size_t> those(const std::vector<size_t>& indices, Condition condition) {
  std::vector<size_t> out;
  std::copy_if(indices.begin(), indices.end(), std::back_inserter(out), condition);
  return out;
}

std::vector<size_t> indicesOf(std::span<const Tried> tried) {
  std::vector<size_t> all(tried.size());
  std::iota(all.begin(), all.end(), size_t{0});
  return all;
}

/// As exact as the most exact, up to that one's noise: the same limit for all, so that none that errs less
/// than one of these is left out.
std::vector<size_t> mostExact(std::span<const Tried> tried, const std::vector<size_t>& among) {
  const ErrorEstimate& best =
      tried[leastBy(among, [&](size_t i) { return tried[i].error.meanSquare; })].error;
  return those(among, [&](size_t i) { return tried[i].error.value() <= best.value() + best.noise(); });
}

/// `a` is no worse than `b` in time and error, and better in one of them.
bool dominates(const Tried& a, const Tried& b) {
  const double ea = a.error.meanSquare, eb = b.error.meanSquare;
  const double ta = a.time.medianMs, tb = b.time.medianMs;
  return ea <= eb && ta <= tb && (ea < eb || ta < tb);
}

}  // namespace

TimeEstimate estimateTime(std::vector<double> framesMs) {
  assert(!framesMs.empty());
  std::sort(framesMs.begin(), framesMs.end());
  return {quantile(framesMs, 0.5), quantile(framesMs, 0.25), quantile(framesMs, 0.75),
          static_cast<int>(framesMs.size())};
}

double margin(std::span<const Tried> tried) {
  std::vector<double> shares;
  for (const Tried& one : tried)
    if (one.error.value() > 0.0) shares.push_back(one.error.high() / one.error.value() - 1.0);
  if (shares.empty()) return 0.0;
  std::sort(shares.begin(), shares.end());
  return quantile(shares, 0.5);
}

bool isWithin(const ErrorEstimate& error, double target, double margin) {
  return error.value() * (1.0 + margin) <= target;
}

std::vector<size_t> eligible(std::span<const Tried> tried, double target) {
  const std::vector<size_t> all = indicesOf(tried);
  const double allowed = margin(tried);
  const std::vector<size_t> within =
      those(all, [&](size_t i) { return isWithin(tried[i].error, target, allowed); });
  return within.empty() ? mostExact(tried, all) : within;
}

Verdict decide(std::span<const Tried> tried, double target) {
  assert(!tried.empty());
  Verdict out{.eligible = eligible(tried, target)};
  out.withinTarget = isWithin(tried[out.eligible.front()].error, target, margin(tried));
  const auto medianMs = [&](size_t i) { return tried[i].time.medianMs; };
  const TimeEstimate& cheapest = tried[leastBy(out.eligible, medianMs)].time;
  const std::vector<size_t> equalTimes =
      those(out.eligible, [&](size_t i) { return tried[i].time.lowMs <= cheapest.highMs; });
  out.chosen = leastBy(mostExact(tried, equalTimes), medianMs);
  // What was equal by its spread may still be dominated by what was not. Each step takes less time or errs
  // less, so this ends.
  for (bool improved = true; improved;) {
    improved = false;
    for (const size_t i : out.eligible)
      if (dominates(tried[i], tried[out.chosen])) out.chosen = i, improved = true;
  }
  return out;
}

std::vector<size_t> front(std::span<const Tried> tried) {
  std::vector<size_t> out = those(indicesOf(tried), [&](size_t i) {
    return std::none_of(tried.begin(), tried.end(),
                        [&](const Tried& other) { return dominates(other, tried[i]); });
  });
  std::stable_sort(out.begin(), out.end(),
                   [&](size_t a, size_t b) { return tried[a].time.medianMs < tried[b].time.medianMs; });
  return out;
}

}  // namespace limen::techniques
