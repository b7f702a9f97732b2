// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/psychometric/objective.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limen::analysis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kEtaMost = 0.9;

/// Fits end here: a threshold at most a range beyond the levels, a width from a tenth of their spacing to ten
/// ranges. Steps and slopes beyond cannot be told from those.
FreeParameter bounded(FitParameter parameter, int condition, const LevelSpread& spread,
                      const FitSettings& settings) {
  const bool map = settings.method == FitMethod::MaximumPosterior;
  const std::optional<double>& width = settings.fixed[indexOf(FitParameter::Width)];
  const double reach = spread.range() > 0.0 ? spread.range() : 3.0 * width.value_or(1.0);
  FreeParameter free{parameter, condition, 0.0, 1.0, 1.0, spread};
  switch (parameter) {
    case FitParameter::Threshold: {
      // The prior ends half a range outside.
      const double beyond = map ? 0.5 * spread.range() * (1.0 - 1e-9) : reach;
      free.low = spread.low - beyond;
      free.high = spread.high + beyond;
      free.scale =
          spread.range() > 0.0 ? std::max(spread.spacing, 1e-3 * spread.range()) : width.value_or(1.0);
      break;
    }
    case FitParameter::Width: {
      const double least =
          map ? spread.spacing * (1.0 + 1e-9) : std::max(0.1 * spread.spacing, 1e-4 * spread.range());
      free.low = std::log(least);
      free.high = std::log(map ? 3.0 * spread.range() * (1.0 - 1e-9) : 10.0 * spread.range());
      break;
    }
    case FitParameter::Guess:
      free.high = settings.guessMost;
      break;
    case FitParameter::Lapse:
      free.high = settings.lapseMost;
      break;
    case FitParameter::Eta:
      free.high = kEtaMost;
      break;
  }
  return free;
}

}  // namespace

Objective::Objective(const std::vector<Condition>& conditions, const FitSettings& settings)
    : shape_(settings), settings_(settings) {
  std::vector<double> all;
  for (const Condition& condition : conditions) {
    blocks_.emplace_back(condition, shape_);
    const std::vector<double>& u = blocks_.back().u;
    all.insert(all.end(), u.begin(), u.end());
    spreads_.push_back(spreadOf(u, settings));
  }
  const LevelSpread common = spreadOf(all, settings);
  for (size_t i = 0; i < kFitParameters; ++i) fixed_[i] = settings.fixed[i].value_or(0.0);
  if (const auto& threshold = settings.fixed[indexOf(FitParameter::Threshold)])
    fixed_[indexOf(FitParameter::Threshold)] = shape_.onAxis(*threshold);
  if (settings.task.kind == FitTask::Kind::ForcedChoice)
    fixed_[indexOf(FitParameter::Guess)] = 1.0 / settings.task.alternatives;

  std::array<int, kFitParameters> sharedPlaces;
  sharedPlaces.fill(-1);
  for (size_t c = 0; c < conditions.size(); ++c) {
    std::array<int, kFitParameters> places;
    places.fill(-1);
    for (size_t i = 0; i < kFitParameters; ++i) {
      const FitParameter parameter = static_cast<FitParameter>(i);
      const bool tied = parameter == FitParameter::Guess && settings.task.kind != FitTask::Kind::YesNo;
      const bool off = parameter == FitParameter::Eta && !settings.overdispersion;
      if (settings.fixed[i] || tied || off) continue;
      if (settings.shared[i] && sharedPlaces[i] >= 0) {
        places[i] = sharedPlaces[i];
        continue;
      }
      places[i] = static_cast<int>(free_.size());
      if (settings.shared[i]) {
        sharedPlaces[i] = places[i];
        free_.push_back(bounded(parameter, -1, common, settings));
      } else {
        // One level alone has no range; where others share its width, theirs serves.
        const LevelSpread& spread = spreads_[c].range() > 0.0 ? spreads_[c] : common;
        free_.push_back(bounded(parameter, static_cast<int>(c), spread, settings));
      }
    }
    places_.push_back(places);
  }
}

std::vector<std::pair<size_t, size_t>> commonPlaces(const Objective& one, size_t c, const Objective& other,
                                                    size_t d) {
  std::vector<std::pair<size_t, size_t>> out;
  for (size_t i = 0; i < kFitParameters; ++i) {
    const int from = one.place(c, static_cast<FitParameter>(i));
    const int to = other.place(d, static_cast<FitParameter>(i));
    if (from >= 0 && to >= 0) out.emplace_back(from, to);
  }
  return out;
}

AxisValues Objective::valuesOf(size_t condition, const double* x) const {
  AxisValues values = fixed_;
  for (size_t i = 0; i < kFitParameters; ++i)
    if (const int place = places_[condition][i]; place >= 0) values[i] = x[place];
  if (places_[condition][indexOf(FitParameter::Width)] >= 0)
    values[indexOf(FitParameter::Width)] = std::exp(values[indexOf(FitParameter::Width)]);
  if (settings_.task.kind == FitTask::Kind::EqualAsymptotes)
    values[indexOf(FitParameter::Guess)] = values[indexOf(FitParameter::Lapse)];
  return values;
}

double Objective::logPriorAt(const double* x, double* gradient) const {
  double sum = 0.0;
  for (size_t j = 0; j < free_.size(); ++j) {
    const bool width = free_[j].parameter == FitParameter::Width;
    const double value = width ? std::exp(x[j]) : x[j];
    const LogPrior prior = logPrior(free_[j].parameter, value, free_[j].spread);
    sum += prior.value;
    if (gradient) gradient[j] -= prior.slope * (width ? value : 1.0);
  }
  return sum;
}

double Objective::evaluate(const double* x, double* gradient) const {
  if (gradient) std::fill(gradient, gradient + free_.size(), 0.0);
  double sum = 0.0;
  for (size_t c = 0; c < blocks_.size(); ++c) {
    const AxisValues values = valuesOf(c, x);
    if (values[indexOf(FitParameter::Guess)] + values[indexOf(FitParameter::Lapse)] >= 1.0) return kInfinity;
    AxisValues slope{};
    sum += negativeLogLikelihood(shape_, blocks_[c], values, gradient ? &slope : nullptr);
    if (!std::isfinite(sum)) return kInfinity;
    if (!gradient) continue;
    slope[indexOf(FitParameter::Width)] *= values[indexOf(FitParameter::Width)];
    for (size_t i = 0; i < kFitParameters; ++i)
      if (const int place = places_[c][i]; place >= 0) gradient[place] += slope[i];
    if (settings_.task.kind == FitTask::Kind::EqualAsymptotes)
      if (const int place = places_[c][indexOf(FitParameter::Lapse)]; place >= 0)
        gradient[place] += slope[indexOf(FitParameter::Guess)];
  }
  if (settings_.method == FitMethod::MaximumPosterior) sum -= logPriorAt(x, gradient);
  return std::isfinite(sum) ? sum : kInfinity;
}

}  // namespace limen::analysis
