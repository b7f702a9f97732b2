// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/answer_fits/fit_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace limen::analysis {
namespace {

constexpr int kCurveSteps = 200;

/// 1, 2, 5, 10, ... where powers of ten alone would be one label or none.
std::string logTics(double low, double high) {
  if (high / low > 1000.0) return {};
  std::string list;
  for (double power = std::pow(10.0, std::floor(std::log10(low))); power <= high; power *= 10.0)
    for (const double step : {1.0, 2.0, 5.0})
      if (step * power >= low && step * power <= high)
        list += fmt::format("{}{:.6g}", list.empty() ? "" : ", ", step * power);
  return list.empty() ? std::string() : "set xtics (" + list + ")\n";
}

bool isBlank(const Block& block, const FitSettings& settings) {
  return block.level == kNoStimulus || (settings.logarithmic() && block.level == 0.0);
}

void setEdges(const FitAnswer& answer, FitChart& chart) {
  double low = INFINITY, high = -INFINITY;
  const auto take = [&](double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  };
  for (size_t c = 0; c < answer.data.size(); ++c) {
    for (const Block& block : answer.data[c].blocks) {
      if (isBlank(block, answer.fit.settings))
        chart.blanks = true;
      else
        take(block.level);
    }
    take(answer.fit.conditions[c].value(FitParameter::Threshold));
  }
  if (chart.logarithmic) {
    const double margin = low < high ? std::pow(high / low, 0.05) : 2.0;
    chart.low = low / margin;
    chart.high = high * margin;
    chart.xTics = logTics(chart.low, chart.high);
  } else {
    const double margin = low < high ? 0.05 * (high - low) : std::max(1.0, std::abs(low));
    chart.low = low - margin;
    chart.high = high + margin;
  }
}

FitSeries seriesOf(const FitAnswer& answer, size_t c, const FitChart& chart) {
  const FitSettings& settings = answer.fit.settings;
  const ConditionFit& fit = answer.fit.conditions[c];
  FitSeries out;
  out.name = answer.data[c].name;
  for (const Block& block : answer.data[c].blocks) {
    if (block.trials == 0) continue;
    const bool blank = isBlank(block, settings);
    out.points.push_back({blank ? (chart.falling ? chart.high : chart.low) : block.level,
                          static_cast<double>(block.correct) / static_cast<double>(block.trials),
                          block.trials, blank});
  }
  for (int i = 0; i <= kCurveSteps; ++i) {
    const double part = static_cast<double>(i) / kCurveSteps;
    const double x = chart.logarithmic ? chart.low * std::pow(chart.high / chart.low, part)
                                       : chart.low + (chart.high - chart.low) * part;
    out.curve.push_back({x, fit.probability(settings, x)});
  }
  const double guess = fit.value(FitParameter::Guess), lapse = fit.value(FitParameter::Lapse);
  out.threshold = fit.value(FitParameter::Threshold);
  out.thresholdShare = guess + (1.0 - guess - lapse) * settings.thresholdLevel;
  out.interval = {out.threshold, out.threshold, false, false};
  if (answer.intervals) out.interval = answer.intervals->conditions[c][0].value_or(out.interval);
  return out;
}

}  // namespace

FitChart chartOf(const FitAnswer& answer) {
  FitChart out;
  out.logarithmic = answer.fit.settings.logarithmic();
  out.falling = answer.fit.settings.falling;
  setEdges(answer, out);
  for (size_t c = 0; c < answer.data.size(); ++c) out.series.push_back(seriesOf(answer, c, out));
  return out;
}

}  // namespace limen::analysis
