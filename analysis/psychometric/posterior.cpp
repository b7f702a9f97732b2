// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "analysis/psychometric/intervals.h"
#include "analysis/psychometric/objective.h"
#include "experiments/base/error.h"
#include "perception/psychometrics/grid_posterior.h"

namespace limen::analysis {
namespace {

using psychometrics::GridAxis;
using psychometrics::GridPosterior;

struct Span {
  FitParameter parameter;
  double low, high;
  size_t count;
  LevelSpread spread;
};

/// As many as a grid of so many dimensions affords.
size_t pointsOf(FitParameter parameter, size_t dimensions) {
  if (dimensions <= 3) return 48;
  if (dimensions == 4) return isRate(parameter) ? 20 : 40;
  return isRate(parameter) ? 12 : 24;
}

/// Values in the middle of equal parts of the span: on the axis, of widths in their logarithm.
GridAxis axisOf(const Span& span) {
  GridAxis axis;
  axis.name = fitParameterNames()[indexOf(span.parameter)];
  axis.logarithmic = span.parameter == FitParameter::Width;
  for (size_t i = 0; i < span.count; ++i) {
    const double at =
        span.low + (span.high - span.low) * (static_cast<double>(i) + 0.5) / static_cast<double>(span.count);
    axis.values.push_back(axis.logarithmic ? std::exp(at) : at);
  }
  return axis;
}

GridPosterior posteriorOf(const Objective& objective, const std::vector<Span>& spans) {
  std::vector<GridAxis> axes;
  std::vector<std::vector<double>> priors;
  for (const Span& span : spans) {
    axes.push_back(axisOf(span));
    std::vector<double> weights;
    double sum = 0.0;
    for (const double value : axes.back().values) {
      const double density = std::exp(logPrior(span.parameter, value, span.spread).value);
      weights.push_back(density * (axes.back().logarithmic ? value : 1.0));
      sum += weights.back();
    }
    for (double& weight : weights) weight /= sum;
    priors.push_back(std::move(weights));
  }
  GridPosterior posterior(axes, priors);
  std::vector<double> logLikelihood(posterior.size());
  std::vector<double> x(spans.size());
  for (size_t point = 0; point < posterior.size(); ++point) {
    for (size_t d = 0; d < spans.size(); ++d) {
      const double value = posterior.grid().valueOf(point, d);
      x[d] = axes[d].logarithmic ? std::log(value) : value;
    }
    const AxisValues values = objective.valuesOf(0, x.data());
    const bool possible = values[indexOf(FitParameter::Guess)] + values[indexOf(FitParameter::Lapse)] < 1.0;
    logLikelihood[point] =
        possible ? -negativeLogLikelihood(objective.shape(), objective.blocks(0), values, nullptr)
                 : -std::numeric_limits<double>::infinity();
  }
  if (!posterior.update(logLikelihood.data()))
    throw Error("no point of the posterior's grid makes these answers possible", "intervals",
                "leave guess and lapse rate free, or above 0");
  return posterior;
}

/// The part of a span that holds all but a hundred-thousandth of the marginal, with a cell more on both
/// sides.
void narrow(const GridPosterior& posterior, size_t d, Span& span) {
  constexpr double kLeft = 5e-6;
  const std::vector<double> marginal = posterior.marginal(d);
  size_t first = 0, last = marginal.size() - 1;
  for (double sum = marginal[first]; first < last && sum < kLeft; sum += marginal[++first]) {
  }
  for (double sum = marginal[last]; last > first && sum < kLeft; sum += marginal[--last]) {
  }
  const double cell = (span.high - span.low) / static_cast<double>(span.count);
  const double low = span.low + cell * (static_cast<double>(first) - 2.0);
  const double high = span.low + cell * (static_cast<double>(last) + 3.0);
  span.high = std::min(span.high, high);
  span.low = std::max(span.low, low);
}

}  // namespace

FitIntervals posteriorIntervals(const std::vector<Condition>& conditions, const Fit& fit, double confidence) {
  if (fit.settings.sharesAny() && conditions.size() > 1)
    throw Error("a posterior of conditions that share parameters has too many dimensions for a grid",
                "intervals", "choose bootstrap, bca, profile or laplace");
  FitIntervals intervals{IntervalMethod::Posterior, confidence, {}, {}};
  FitSettings settings = fit.settings;
  settings.method = FitMethod::MaximumPosterior;  // bounds of the priors
  if (settings.fixed[indexOf(FitParameter::Threshold)] && settings.fixed[indexOf(FitParameter::Width)])
    settings.method = fit.settings.method;
  for (const Condition& condition : conditions) {
    checkFit({condition}, settings);
    const Objective objective({condition}, settings);
    ConditionIntervals found;
    std::vector<Span> spans;
    for (const FreeParameter& free : objective.free())
      spans.push_back(
          {free.parameter, free.low, free.high, pointsOf(free.parameter, objective.size()), free.spread});
    if (!spans.empty()) {
      // Wide first, then where the posterior is, until that is not much less.
      for (int pass = 0; pass < 12; ++pass) {
        const GridPosterior posterior = posteriorOf(objective, spans);
        bool smaller = false;
        for (size_t d = 0; d < spans.size(); ++d) {
          const double before = spans[d].high - spans[d].low;
          narrow(posterior, d, spans[d]);
          smaller |= spans[d].high - spans[d].low < 0.7 * before;
        }
        if (!smaller) break;
      }
      if (spans.size() > 3) {
        std::string cells;
        for (const Span& span : spans)
          if (isRate(span.parameter))
            cells += fmt::format("{}{} {:.2g}", cells.empty() ? "" : ", ",
                                 fitParameterNames()[indexOf(span.parameter)],
                                 (span.high - span.low) / static_cast<double>(span.count));
        intervals.warnings.push_back(fmt::format(
            "{}{} free parameters leave the posterior a coarse grid; ends are good to about half a cell ({})",
            condition.name.empty() ? "" : condition.name + ": ", spans.size(), cells));
      }
      const GridPosterior posterior = posteriorOf(objective, spans);
      for (size_t d = 0; d < spans.size(); ++d) {
        const psychometrics::CredibleInterval own = posterior.equalTailed(d, confidence);
        FitInterval interval{{own.low, own.high}};
        if (spans[d].parameter == FitParameter::Threshold) {
          const auto [low, high] = objective.shape().offAxis(own.low, own.high);
          interval.low = low;
          interval.high = high;
        }
        found[indexOf(spans[d].parameter)] = interval;
      }
    }
    found[kFitParameters] = slopeOfWidth(fit.conditions[intervals.conditions.size()], settings, found);
    if (settings.task.kind == FitTask::Kind::EqualAsymptotes)
      found[indexOf(FitParameter::Guess)] = found[indexOf(FitParameter::Lapse)];
    intervals.conditions.push_back(found);
  }
  return intervals;
}

}  // namespace limen::analysis
