// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/link_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "analysis/psychometric/bootstrap.h"
#include "analysis/psychometric/fit_settings.h"
#include "perception/psychometrics/random.h"

namespace limen::analysis {
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
  std::atomic<size_t> next{0};
  const auto work = [&] {
    for (size_t i; (i = next++) < samples.size();) {
      psychometrics::Random random(psychometrics::childSeed(setting.seed, fmt::format("observers {}", i)));
      Weights weights(observers, 0);
      for (size_t drawn = 0; drawn < observers; ++drawn) ++weights[random.below(observers)];
      samples[i] = reportOf(data, setting, weights);
    }
  };
  std::vector<std::thread> others;
  for (unsigned t = 1; t < setting.threads; ++t) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
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

LinkReport linkReport(const LinkData& data, const LinkReportSetting& setting, size_t observers) {
  LinkReport report = reportOf(data, setting, Weights(observers, 1));
  if (setting.samples > 0 && observers > 1) report.intervals = intervalsOf(data, setting, observers);
  return report;
}

}  // namespace limen::analysis
