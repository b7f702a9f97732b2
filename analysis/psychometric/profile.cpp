// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "analysis/psychometric/intervals.h"
#include "analysis/psychometric/objective.h"
#include "analysis/psychometric/optimiser.h"
#include "analysis/statistics/distributions.h"

namespace limen::analysis {
namespace {

/// The objective that condition `c` belongs to and where its optimum lies: conditions that share nothing have
/// one each.
struct Own {
  Objective objective;
  std::vector<double> x;
  size_t condition;
};

Own ownOf(const std::vector<Condition>& conditions, const Fit& fit, size_t c) {
  Objective joint(conditions, fit.settings);
  if (fit.settings.sharesAny() || conditions.size() == 1) return {std::move(joint), fit.x, c};
  Objective alone({conditions[c]}, fit.settings);
  std::vector<double> x(alone.size());
  for (const auto& [from, to] : commonPlaces(joint, c, alone, 0)) x[to] = fit.x[from];
  return {std::move(alone), std::move(x), 0};
}

/// The value of parameter j on one side at which the profile has risen by `rise`.
struct Limit {
  double value;
  bool open;
};

Limit profileLimit(const Objective& objective, const std::vector<double>& optimum, size_t j, int side,
                   double rise) {
  const FreeParameter& free = objective.free()[j];
  const double bound = side < 0 ? free.low : free.high;
  const double least = objective.evaluate(optimum.data(), nullptr);
  std::vector<bool> held(optimum.size(), false);
  held[j] = true;
  std::vector<double> last = optimum;
  // Distance in units in which a quadratic profile is a straight line. The best of two starts: where the
  // profile was before, and the optimum.
  const auto excess = [&](double value) {
    std::vector<double> start = last;
    start[j] = value;
    Optimum found = minimise(objective, start, held);
    start = optimum;
    start[j] = value;
    const Optimum other = minimise(objective, start, held);
    if (!(found.value <= other.value)) found = other;
    if (!std::isfinite(found.value)) return 1e6;
    last = found.x;
    return std::sqrt(std::max(0.0, found.value - least)) - std::sqrt(rise);
  };
  double inside = optimum[j], below = -std::sqrt(rise);
  double step = 0.5 * free.scale;
  double outside = inside, above = below;
  while (above < 0.0) {
    // That rates end at 0 is no limit of the fit.
    if (outside == bound) return {bound, side > 0 || !isRate(free.parameter)};
    inside = outside;
    below = above;
    outside = side < 0 ? std::max(bound, outside - step) : std::min(bound, outside + step);
    above = excess(outside);
    step *= 1.8;
  }
  // Illinois: false position that halves the weight of an end that stays.
  int stayed = 0;
  for (int i = 0; i < 60 && std::abs(outside - inside) > 1e-7 * free.scale; ++i) {
    const double middle = std::clamp(inside - below * (outside - inside) / (above - below),
                                     std::min(inside, outside), std::max(inside, outside));
    const double value = excess(middle);
    if (std::abs(value) < 1e-8) return {middle, false};
    if (value < 0.0) {
      inside = middle;
      below = value;
      if (stayed == -1) above *= 0.5;
      stayed = -1;
    } else {
      outside = middle;
      above = value;
      if (stayed == 1) below *= 0.5;
      stayed = 1;
    }
  }
  return {0.5 * (inside + outside), false};
}

FitInterval offScale(const Objective& objective, FitParameter parameter, const FitInterval& own) {
  FitInterval out = own;
  if (parameter == FitParameter::Width) {
    out.low = std::exp(own.low);
    out.high = std::exp(own.high);
  } else if (parameter == FitParameter::Threshold) {
    const auto [low, high] = objective.shape().offAxis(own.low, own.high);
    out.low = low;
    out.high = high;
    if (objective.shape().falling) std::swap(out.lowOpen, out.highOpen);
  }
  return out;
}

void tieGuess(const FitSettings& settings, ConditionIntervals& own) {
  if (settings.task.kind == FitTask::Kind::EqualAsymptotes)
    own[indexOf(FitParameter::Guess)] = own[indexOf(FitParameter::Lapse)];
}

}  // namespace

FitIntervals profileIntervals(const std::vector<Condition>& conditions, const Fit& fit, double confidence) {
  FitIntervals intervals{IntervalMethod::Profile, confidence, {}, {}};
  // The quantile of chi-squared with one degree of freedom is that of the normal, squared.
  const double z = normalQuantile(0.5 * (1.0 + confidence));
  for (size_t c = 0; c < conditions.size(); ++c) {
    const Own own = ownOf(conditions, fit, c);
    ConditionIntervals found;
    for (size_t i = 0; i < kFitParameters; ++i) {
      const FitParameter parameter = static_cast<FitParameter>(i);
      const int place = own.objective.place(own.condition, parameter);
      if (place < 0) continue;
      const Limit low = profileLimit(own.objective, own.x, static_cast<size_t>(place), -1, 0.5 * z * z);
      const Limit high = profileLimit(own.objective, own.x, static_cast<size_t>(place), 1, 0.5 * z * z);
      found[i] = offScale(own.objective, parameter, {{low.value, high.value}, low.open, high.open});
    }
    tieGuess(fit.settings, found);
    found[kFitParameters] = slopeOfWidth(fit.conditions[c], fit.settings, found);
    intervals.conditions.push_back(found);
  }
  return intervals;
}

FitIntervals laplaceIntervals(const std::vector<Condition>& conditions, const Fit& fit, double confidence) {
  FitIntervals intervals{IntervalMethod::Laplace, confidence, {}, {}};
  const double z = normalQuantile(0.5 * (1.0 + confidence));
  for (size_t c = 0; c < conditions.size(); ++c) {
    if (fit.conditions[c].atBound[indexOf(FitParameter::Threshold)] != 0 ||
        fit.conditions[c].atBound[indexOf(FitParameter::Width)] != 0) {
      intervals.warnings.push_back(
          fit.conditions[c].prefix() +
          std::string("no Laplace intervals, as the fit is at a bound; 'profile' and "
                      "'posterior' say what the answers leave open"));
      intervals.conditions.emplace_back();
      continue;
    }
    const Own own = ownOf(conditions, fit, c);
    const std::vector<double> all = secondDerivatives(own.objective, own.x);
    const size_t size = own.x.size();
    // What is at a bound has no curvature to go by and is held there.
    std::vector<Eigen::Index> inside;
    std::vector<int> place(size, -1);
    for (size_t j = 0; j < size; ++j) {
      const FreeParameter& free = own.objective.free()[j];
      const double near = 1e-6 * (free.high - free.low);
      if (own.x[j] <= free.low + near || own.x[j] >= free.high - near) continue;
      place[j] = static_cast<int>(inside.size());
      inside.push_back(static_cast<Eigen::Index>(j));
    }
    const auto n = static_cast<Eigen::Index>(inside.size()), whole = static_cast<Eigen::Index>(size);
    const Eigen::MatrixXd h = Eigen::Map<const Eigen::MatrixXd>(all.data(), whole, whole)(inside, inside);
    const Eigen::LLT<Eigen::MatrixXd> cholesky(h);
    const std::string of = fit.conditions[c].prefix();
    ConditionIntervals found;
    if (!h.allFinite() || cholesky.info() != Eigen::Success) {
      intervals.warnings.push_back(of +
                                   "the curvature at the optimum is not that of a maximum; no intervals");
      intervals.conditions.push_back(found);
      continue;
    }
    if (inside.size() < size)
      intervals.warnings.push_back(of +
                                   "parameters at a bound have no interval, and those of the others take "
                                   "them for known");
    const Eigen::MatrixXd covariance = cholesky.solve(Eigen::MatrixXd::Identity(n, n));
    Eigen::VectorXd logSlope = Eigen::VectorXd::Zero(n);
    for (size_t i = 0; i < kFitParameters; ++i) {
      const FitParameter parameter = static_cast<FitParameter>(i);
      const int at = own.objective.place(own.condition, parameter);
      if (at < 0 || place[static_cast<size_t>(at)] < 0) continue;
      const Eigen::Index k = place[static_cast<size_t>(at)];
      const double half = z * std::sqrt(covariance(k, k)), middle = own.x[static_cast<size_t>(at)];
      const FreeParameter& free = own.objective.free()[static_cast<size_t>(at)];
      // Wider than all that the fit considers: no normal distribution any more.
      if (!(half < free.high - free.low)) {
        intervals.warnings.push_back(of + "the curvature tells nothing of the " + fitParameterNames()[i]);
        continue;
      }
      // Rates stay rates.
      const bool rate = isRate(parameter);
      const double low = rate ? std::max(middle - half, 0.0) : middle - half;
      const double high = rate ? std::min(middle + half, free.high) : middle + half;
      found[i] = offScale(own.objective, parameter, {{low, high}});
      // ln |slope| = constant - ln w, on a logarithmic axis - t as well, which u is the negative of if F
      // falls.
      if (parameter == FitParameter::Width) logSlope[k] = -1.0;
      if (parameter == FitParameter::Threshold && fit.settings.logarithmic())
        logSlope[k] = fit.settings.falling ? 1.0 : -1.0;
    }
    const double half = z * std::sqrt(logSlope.dot(covariance * logSlope));
    // More than a factor of a thousand is no answer either.
    if (logSlope.any() && half < 7.0) {
      const double slope = fit.conditions[c].slope;
      const auto [low, high] = std::minmax({slope * std::exp(-half), slope * std::exp(half)});
      found[kFitParameters] = FitInterval{{low, high}};
    }
    tieGuess(fit.settings, found);
    intervals.conditions.push_back(found);
  }
  return intervals;
}

}  // namespace limen::analysis
