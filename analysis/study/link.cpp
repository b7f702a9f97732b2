// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/link.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace limen::analysis {
namespace {

constexpr double kMostGuess = 0.5, kMostLapse = 0.2;
/// Keeps the logarithm of a probability of 0 or 1 finite.
constexpr double kLeastProbability = 1e-12;

double clipped(double probability) {
  return std::clamp(probability, kLeastProbability, 1.0 - kLeastProbability);
}

double logLikelihood(const Link& link, const std::vector<LinkPoint>& points) {
  double sum = 0.0;
  for (const LinkPoint& point : points) {
    const double p = clipped(link.probability(point.rating));
    sum += static_cast<double>(point.yes) * std::log(p) +
           static_cast<double>(point.trials - point.yes) * std::log1p(-p);
  }
  return sum;
}

/// Midpoint, ln of the scale, guess and lapse rate within bounds.
using Values = std::array<double, 4>;
struct Box {
  Values low{}, high{};
};

Link linkOf(const Values& values) {
  Link out;
  out.midpointR = values[0];
  out.scaleR = std::exp(values[1]);
  out.guess = values[2];
  out.lapse = values[3];
  return out;
}

/// Pattern search: of all neighbours a step away in any combination of directions the best, until none is
/// better at the smallest step. Slow and sure for four parameters at most, and the same on every machine.
Values climb(Values start, const Box& box, const std::vector<LinkPoint>& points) {
  double best = logLikelihood(linkOf(start), points);
  // What rounding adds up to must not count as better, or steps would never shrink.
  const auto isBetter = [&](double value) { return value > best + 1e-12 * (1.0 + std::abs(best)); };
  Values mark = start;
  int moves = 0;
  for (double step = 0.125; step > 1e-9;) {
    Values next = start;
    double nextValue = best;
    for (int code = 0; code < 81; ++code) {
      Values tried = start;
      bool moved = false, fixed = false;
      for (size_t i = 0, rest = static_cast<size_t>(code); i < tried.size(); ++i, rest /= 3) {
        const double way = static_cast<double>(rest % 3) - 1.0;
        if (way == 0.0) continue;
        fixed = fixed || box.low[i] == box.high[i];
        tried[i] = std::clamp(start[i] + way * step * (box.high[i] - box.low[i]), box.low[i], box.high[i]);
        moved = moved || tried[i] != start[i];
      }
      if (!moved || fixed) continue;
      const double value = logLikelihood(linkOf(tried), points);
      if (value > nextValue) nextValue = value, next = tried;
    }
    if (!isBetter(nextValue)) {
      step *= 0.5;
      continue;
    }
    start = next;
    best = nextValue;
    if (++moves % 64 != 0) continue;
    // Along a narrow ridge steps are many and small: stride on to where the last ones led.
    Values way{};
    for (size_t i = 0; i < way.size(); ++i) way[i] = start[i] - mark[i];
    for (double stride = 1.0;; stride *= 2.0) {
      Values tried = start;
      for (size_t i = 0; i < tried.size(); ++i)
        tried[i] = std::clamp(start[i] + stride * way[i], box.low[i], box.high[i]);
      const double value = logLikelihood(linkOf(tried), points);
      if (!isBetter(value)) break;
      start = tried;
      best = value;
    }
    mark = start;
  }
  return start;
}

/// What of the best values the answers do not tell.
std::string doubts(const Values& at, const Box& box, const LinkSetting& setting,
                   const std::vector<LinkPoint>& points) {
  std::string out;
  const auto say = [&](const std::string& words) { out += (out.empty() ? "" : "; ") + words; };
  if (at[0] == box.low[0] || at[0] == box.high[0]) say("the midpoint lies far beyond the ratings");
  Values steeper = at;
  steeper[1] -= std::log(2.0);
  const double best = logLikelihood(linkOf(at), points);
  if (at[1] == box.low[1] || logLikelihood(linkOf(steeper), points) > best - 1e-6 * (1.0 + std::abs(best)))
    say("ratings part yes from no without overlap: a smaller scale fits as well");
  if (at[1] == box.high[1]) say("answers hardly depend on the rating");
  if (!setting.guess && (at[2] == box.low[2] || at[2] == box.high[2])) say("the guess rate is at its edge");
  if (!setting.lapse && (at[3] == box.low[3] || at[3] == box.high[3])) say("the lapse rate is at its edge");
  return out;
}

}  // namespace

double Link::probability(double rating) const {
  const double x = (rating - midpointR) / scaleR;
  if (std::isnan(x)) return guess;
  return guess + (1.0 - guess - lapse) / (1.0 + std::exp(-x));
}

std::optional<Link> fitLink(const std::vector<LinkPoint>& points, const LinkSetting& setting) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  int64_t yes = 0, trials = 0;
  for (const LinkPoint& point : points) {
    if (!std::isfinite(point.rating)) continue;
    least = std::min(least, point.rating);
    most = std::max(most, point.rating);
    yes += point.yes;
    trials += point.trials;
  }
  const double range = most - least;
  if (!(range > 0.0) || yes == 0 || yes == trials) return {};
  Box box;
  box.low = {least - range, std::log(range / 200.0), setting.guess.value_or(0.0),
             setting.lapse.value_or(0.0)};
  box.high = {most + range, std::log(range * 5.0), setting.guess.value_or(kMostGuess),
              setting.lapse.value_or(kMostLapse)};
  const double guess = setting.guess.value_or(0.05), lapse = setting.lapse.value_or(0.02);
  std::optional<Link> best;
  // The likelihood may have several hills; steep starts find what shallow ones pass by.
  for (const double place : {0.25, 0.5, 0.75})
    for (const double steepness : {0.02, 0.2}) {
      const Values end =
          climb({least + place * range, std::log(steepness * range), guess, lapse}, box, points);
      Link link = linkOf(end);
      link.logLikelihood = logLikelihood(link, points);
      if (best && link.logLikelihood <= best->logLikelihood) continue;
      link.guessFitted = !setting.guess;
      link.lapseFitted = !setting.lapse;
      link.note = doubts(end, box, setting, points);
      best = link;
    }
  return best;
}

LinkError linkError(const std::vector<LinkPoint>& points, const std::vector<double>& probabilities) {
  assert(points.size() == probabilities.size());
  LinkError out;
  double trials = 0.0;
  // What was never answered costs nothing, even where it had a probability of 0.
  const auto cost = [](double count, double p) { return count > 0.0 ? -count * std::log(p) : 0.0; };
  for (size_t i = 0; i < points.size(); ++i) {
    const auto yes = static_cast<double>(points[i].yes), all = static_cast<double>(points[i].trials);
    const double p = probabilities[i];
    out.logLoss += cost(yes, p) + cost(all - yes, 1.0 - p);
    out.brier += yes * (1.0 - p) * (1.0 - p) + (all - yes) * p * p;
    out.rmsRate += (p - yes / all) * (p - yes / all);
    trials += all;
  }
  out.logLoss /= trials;
  out.brier /= trials;
  out.rmsRate = std::sqrt(out.rmsRate / static_cast<double>(points.size()));
  return out;
}

std::optional<std::vector<double>> leaveOneOut(const std::vector<LinkPoint>& points,
                                               const LinkSetting& setting) {
  std::vector<double> out;
  for (size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].rating)) continue;
    std::vector<LinkPoint> others = points;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const std::optional<Link> link = fitLink(others, setting);
    if (!link) return {};
    out.push_back(link->probability(points[i].rating));
  }
  return out;
}

}  // namespace limen::analysis
