// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/link.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "analysis/psychometric/fit.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

constexpr double kMostGuess = 0.5, kMostLapse = 0.2;
/// From F = 0.05 to 0.95 a logistic takes as many scales.
const double kScalesPerWidth = 2.0 * std::log(19.0);

double logLikelihood(const Link& link, const std::vector<LinkPoint>& points) {
  double sum = 0.0;
  // What was never answered costs nothing, even where it had a probability of 0.
  const auto gain = [](int64_t count, double p) {
    return count > 0 ? static_cast<double>(count) * std::log(p) : 0.0;
  };
  for (const LinkPoint& point : points) {
    const double p = link.probability(point.rating);
    sum += gain(point.yes, p) + gain(point.trials - point.yes, 1.0 - p);
  }
  return sum;
}

/// What of the best values the answers do not tell.
std::string doubts(const ConditionFit& fit) {
  std::string out;
  const auto say = [&](const std::string& words) { out += (out.empty() ? "" : "; ") + words; };
  const auto at = [&](FitParameter parameter) { return fit.atBound[indexOf(parameter)]; };
  if (at(FitParameter::Threshold) != 0) say("the midpoint lies far beyond the ratings");
  if (at(FitParameter::Width) < 0)
    say("ratings part yes from no without overlap: a smaller scale fits as well");
  if (at(FitParameter::Width) > 0) say("answers hardly depend on the rating");
  if (at(FitParameter::Guess) != 0) say("the guess rate is at its edge");
  if (at(FitParameter::Lapse) != 0) say("the lapse rate is at its edge");
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
  Condition condition;
  for (const LinkPoint& point : points) {
    condition.blocks.push_back({point.rating, point.yes, point.trials, 0.0});
    if (!std::isfinite(point.rating) || point.trials == 0) continue;
    least = std::min(least, point.rating);
    most = std::max(most, point.rating);
    yes += point.yes;
    trials += point.trials;
  }
  if (!(most > least) || yes == 0 || yes == trials) return {};
  FitSettings settings;
  settings.sigmoid = psychometrics::SigmoidFamily::Logistic;
  settings.task = {FitTask::Kind::YesNo, 0};
  settings.fixed[indexOf(FitParameter::Guess)] = setting.guess;
  settings.fixed[indexOf(FitParameter::Lapse)] = setting.lapse;
  settings.guessMost = kMostGuess;
  settings.lapseMost = kMostLapse;
  Link out;
  try {
    const ConditionFit fit = fitPsychometric({condition}, settings, "link").conditions[0];
    out.midpointR = fit.value(FitParameter::Threshold);
    out.scaleR = fit.value(FitParameter::Width) / kScalesPerWidth;
    out.guess = fit.value(FitParameter::Guess);
    out.lapse = fit.value(FitParameter::Lapse);
    out.note = doubts(fit);
  } catch (const Error&) {
    return {};  // rates that are held make the answers impossible
  }
  out.logLikelihood = logLikelihood(out, points);
  out.guessFitted = !setting.guess;
  out.lapseFitted = !setting.lapse;
  return out;
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
