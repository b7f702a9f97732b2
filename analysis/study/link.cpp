// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/link.h"

#include <fmt/format.h>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "analysis/psychometric/bootstrap.h"
#include "analysis/psychometric/fit.h"
#include "analysis/psychometric/fit_settings.h"
#include "analysis/statistics/summary.h"
#include "experiments/base/error.h"
#include "perception/psychometrics/random.h"

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

namespace {

/// How often each observer counts.
using Weights = std::vector<int64_t>;

YesCount sumOf(const ObserverCounts& counts, const Weights& weights) {
  YesCount out;
  for (const auto& [observer, count] : counts) {
    out.yes += weights[observer] * count.yes;
    out.trials += weights[observer] * count.trials;
  }
  return out;
}

LinkReport reportOf(const LinkData& data, const LinkReportSetting& setting, const Weights& weights) {
  LinkReport report;
  const YesCount catches = sumOf(data.catches, weights);
  report.catchTrials = catches.trials;
  if (catches.trials > 0)
    report.guessFromCatch = static_cast<double>(catches.yes) / static_cast<double>(catches.trials);
  std::vector<LinkPoint> points;
  std::vector<double> predicted, constant;
  YesCount all;
  for (size_t i = 0; i < data.ratings.size(); ++i) {
    const YesCount own = sumOf(data.answers[i], weights);
    if (own.trials == 0) continue;  // none of its observers was drawn
    points.push_back({data.ratings[i], own.yes, own.trials});
    predicted.push_back(data.predicted[i]);
    all.yes += own.yes;
    all.trials += own.trials;
  }
  if (points.empty()) return report;
  for (const LinkPoint& point : points)
    if (all.trials > point.trials)
      constant.push_back(static_cast<double>(all.yes - point.yes) /
                         static_cast<double>(all.trials - point.trials));
  report.asPredicted = linkError(points, predicted);
  if (constant.size() == points.size()) report.constant = linkError(points, constant);
  LinkSetting link = setting.link;
  std::vector<LinkPoint> fitted = points;
  if (setting.fitGuess) {
    if (catches.trials > 0) fitted.push_back({kNoStimulus, catches.yes, catches.trials});
  } else if (!link.guess) {
    link.guess = report.guessFromCatch;
  }
  report.refit = fitLink(fitted, link);
  if (!report.refit) return report;
  if (const auto left = leaveOneOut(fitted, link)) report.refitError = linkError(points, *left);
  return report;
}

/// Of what the samples told, if that was at least half of them.
std::optional<Interval> percentiles(std::vector<double> values, size_t samples) {
  if (values.size() < 2 || 2 * values.size() < samples) return {};
  std::sort(values.begin(), values.end());
  const Interval out{sortedQuantile(values, 0.025), sortedQuantile(values, 0.975)};
  if (!std::isfinite(out.low) || !std::isfinite(out.high)) return {};
  return out;
}

LinkErrorIntervals errorIntervals(const std::vector<LinkReport>& samples,
                                  std::optional<LinkError> LinkReport::*which) {
  const auto of = [&](double LinkError::*figure) {
    std::vector<double> values;
    for (const LinkReport& sample : samples)
      if (const std::optional<LinkError>& error = sample.*which) values.push_back((*error).*figure);
    return percentiles(std::move(values), samples.size());
  };
  return {of(&LinkError::logLoss), of(&LinkError::brier), of(&LinkError::rmsRate)};
}

LinkIntervals intervalsOf(const LinkData& data, const LinkReportSetting& setting, size_t observers) {
  std::vector<LinkReport> samples(setting.samples);
  // Leaving out makes a fit of each scenario and sample: seconds to minutes.
  inThreads(samples.size(), setting.threads, [&](size_t i) {
    psychometrics::Random random(psychometrics::childSeed(setting.seed, fmt::format("observers {}", i)));
    Weights weights(observers, 0);
    for (size_t drawn = 0; drawn < observers; ++drawn) ++weights[random.below(observers)];
    samples[i] = reportOf(data, setting, weights);
  });
  const auto of = [&](double Link::*parameter) {
    std::vector<double> values;
    for (const LinkReport& sample : samples)
      if (sample.refit) values.push_back((*sample.refit).*parameter);
    return percentiles(std::move(values), samples.size());
  };
  LinkIntervals out;
  out.samples = samples.size();
  out.fitted = static_cast<size_t>(std::count_if(
      samples.begin(), samples.end(), [](const LinkReport& sample) { return sample.refit.has_value(); }));
  out.seed = setting.seed;
  if (setting.fitGuess || !setting.link.guess) out.guess = of(&Link::guess);
  if (!setting.link.lapse) out.lapse = of(&Link::lapse);
  out.midpointR = of(&Link::midpointR);
  out.scaleR = of(&Link::scaleR);
  out.refitError = errorIntervals(samples, &LinkReport::refitError);
  out.asPredicted = errorIntervals(samples, &LinkReport::asPredicted);
  out.constant = errorIntervals(samples, &LinkReport::constant);
  return out;
}

}  // namespace

double meanRate(const ObserverCounts& counts) {
  double sum = 0.0;
  for (const auto& [observer, count] : counts)
    sum += static_cast<double>(count.yes) / static_cast<double>(count.trials);
  return sum / static_cast<double>(counts.size());
}

LinkReport linkReport(const LinkData& data, const LinkReportSetting& setting, size_t observers) {
  LinkReport report = reportOf(data, setting, Weights(observers, 1));
  if (setting.samples > 0 && observers > 1) report.intervals = intervalsOf(data, setting, observers);
  return report;
}

}  // namespace limen::analysis
