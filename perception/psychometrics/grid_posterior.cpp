// SPDX-License-Identifier: BSD-3-Clause
#include "perception/psychometrics/grid_posterior.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/text.h"

namespace limen::psychometrics {
namespace {

using nlohmann::json;

const char* const kPriors =
    "uniform, {normal: {mean, sd}}, {beta: {a, b}} or a list of weights, one per value";

double priorNumber(const json& object, const char* key, const std::string& where) {
  if (!object.contains(key) || !object[key].is_number()) {
    throw Error(std::string("'") + key + "' is missing or not a number", where, "give a number");
  }
  return object[key].get<double>();
}

void allowKeys(const json& object, const std::vector<std::string>& known, const std::string& where) {
  if (!object.is_object()) throw Error("found " + object.dump(), where, std::string("give ") + kPriors);
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw Error("unknown key '" + key + "'", where, suggest(key, known));
    }
  }
}

std::vector<double> normalWeights(const json& settings, const GridAxis& axis, const std::string& where) {
  allowKeys(settings, {"mean", "sd"}, where);
  const double mean = priorNumber(settings, "mean", where), sd = priorNumber(settings, "sd", where);
  if (!(sd > 0.0)) throw Error("the standard deviation is not above 0", where + ".sd");
  // Relative to the most likely value: a mean far off the axis still gives a prior.
  double least = std::numeric_limits<double>::infinity();
  for (double value : axis.values) least = std::min(least, std::abs(value - mean) / sd);
  std::vector<double> weights;
  for (double value : axis.values) {
    const double z = (value - mean) / sd;
    weights.push_back(std::exp(-0.5 * (z - least) * (z + least)));
  }
  return weights;
}

std::vector<double> betaWeights(const json& settings, const GridAxis& axis, const std::string& where) {
  allowKeys(settings, {"a", "b"}, where);
  const double a = priorNumber(settings, "a", where), b = priorNumber(settings, "b", where);
  if (!(a > 0.0 && b > 0.0)) throw Error("'a' and 'b' of a beta prior must be above 0", where);
  if (axis.values.front() < 0.0 || axis.values.back() > 1.0) {
    throw Error("a beta prior is for values from 0 to 1", where, "change the values or the prior");
  }
  std::vector<double> weights;
  for (double value : axis.values) {
    const double weight = std::pow(value, a - 1.0) * std::pow(1.0 - value, b - 1.0);
    if (!std::isfinite(weight)) {
      throw Error("the beta prior is infinite at " + shortestNumber(value), where,
                  "leave that value out or use a and b of at least 1");
    }
    weights.push_back(weight);
  }
  return weights;
}

std::vector<double> listedWeights(const json& list, const GridAxis& axis, const std::string& where) {
  if (list.size() != axis.size()) {
    throw Error("the prior has " + std::to_string(list.size()) + " weights for " +
                    std::to_string(axis.size()) + " values",
                where, "give one weight per value");
  }
  std::vector<double> weights;
  for (const json& entry : list) {
    if (!entry.is_number() || !(entry.get<double>() >= 0.0) || !std::isfinite(entry.get<double>())) {
      throw Error("found " + entry.dump() + " as a weight", where, "give numbers of at least 0");
    }
    weights.push_back(entry.get<double>());
  }
  return weights;
}

// Borders of the histogram's cells: cell i lies between border i and i + 1.
std::vector<double> cellBorders(const GridAxis& axis) {
  const std::vector<double>& v = axis.values;
  const size_t n = v.size();
  if (n == 1) return {v[0], v[0]};
  std::vector<double> borders(n + 1);
  for (size_t i = 1; i < n; ++i) {
    borders[i] = axis.logarithmic ? std::sqrt(v[i - 1] * v[i]) : 0.5 * (v[i - 1] + v[i]);
  }
  borders[0] = axis.logarithmic ? v[0] * v[0] / borders[1] : 2.0 * v[0] - borders[1];
  borders[n] = axis.logarithmic ? v[n - 1] * v[n - 1] / borders[n - 1] : 2.0 * v[n - 1] - borders[n - 1];
  return borders;
}

// Distribution function of a histogram, at the borders; piecewise linear between.
struct Histogram {
  std::vector<double> border, below;  // below[i]: probability left of border i

  Histogram(const GridAxis& axis, const std::vector<double>& marginal)
      : border(cellBorders(axis)), below(marginal.size() + 1, 0.0) {
    for (size_t i = 0; i < marginal.size(); ++i) below[i + 1] = below[i] + marginal[i];
  }

  double quantile(double p) const {
    const double target = p * below.back();  // the sum is 1 up to rounding
    size_t i = 0;
    while (i + 2 < below.size() && below[i + 1] < target) ++i;
    const double mass = below[i + 1] - below[i];
    const double part = mass > 0.0 ? std::clamp((target - below[i]) / mass, 0.0, 1.0) : 0.0;
    return border[i] + part * (border[i + 1] - border[i]);
  }
};

double clampToAxis(const GridAxis& axis, double value) {
  return std::clamp(value, axis.values.front(), axis.values.back());
}

}  // namespace

std::vector<double> uniformPrior(const GridAxis& axis) {
  return std::vector<double>(axis.size(), 1.0 / static_cast<double>(axis.size()));
}

std::vector<double> readPrior(const json& source, const GridAxis& axis, const std::string& where) {
  if (source == "uniform") return uniformPrior(axis);
  std::vector<double> weights;
  if (source.is_array()) {
    weights = listedWeights(source, axis, where);
  } else if (source.is_object() && source.size() == 1 && source.contains("normal")) {
    weights = normalWeights(source["normal"], axis, where + ".normal");
  } else if (source.is_object() && source.size() == 1 && source.contains("beta")) {
    weights = betaWeights(source["beta"], axis, where + ".beta");
  } else {
    throw Error("no prior " + source.dump(), where, std::string("give ") + kPriors);
  }
  double sum = 0.0;
  for (double weight : weights) sum += weight;
  if (!(sum > 0.0) || !std::isfinite(sum)) {
    throw Error("the weights of the prior do not sum to a positive number", where,
                "give at least one weight above 0");
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

GridPosterior::GridPosterior(std::vector<GridAxis> axes, const std::vector<std::vector<double>>& priors)
    : grid_(std::move(axes)), logWeight_(grid_.size()), probability_(grid_.size()) {
  assert(priors.size() == grid_.dimensions());
  for (size_t point = 0; point < size(); ++point) {
    double sum = 0.0;
    for (size_t d = 0; d < grid_.dimensions(); ++d) sum += std::log(priors[d][grid_.indexOf(point, d)]);
    logWeight_[point] = sum;
  }
  normalise();
}

bool GridPosterior::update(const double* logLikelihood) {
  bool possible = false;
  for (size_t i = 0; i < size(); ++i) {
    possible = possible || logWeight_[i] + logLikelihood[i] > -std::numeric_limits<double>::infinity();
  }
  if (!possible) return false;
  for (size_t i = 0; i < size(); ++i) logWeight_[i] += logLikelihood[i];
  normalise();
  return true;
}

void GridPosterior::normalise() {
  const double largest = *std::max_element(logWeight_.begin(), logWeight_.end());
  double sum = 0.0;
  for (size_t i = 0; i < size(); ++i) {
    logWeight_[i] -= largest;
    probability_[i] = std::exp(logWeight_[i]);
    sum += probability_[i];
  }
  for (double& p : probability_) p /= sum;
}

double GridPosterior::entropy() const {
  double sum = 0.0;
  for (double p : probability_) sum += p > 0.0 ? p * std::log(p) : 0.0;
  return -sum;
}

size_t GridPosterior::modePoint() const {
  return static_cast<size_t>(std::max_element(logWeight_.begin(), logWeight_.end()) - logWeight_.begin());
}

std::vector<double> GridPosterior::marginal(size_t dimension) const {
  std::vector<double> sums(grid_.axes()[dimension].size(), 0.0);
  for (size_t i = 0; i < size(); ++i) sums[grid_.indexOf(i, dimension)] += probability_[i];
  return sums;
}

double GridPosterior::mean(size_t dimension) const {
  const std::vector<double>& values = grid_.axes()[dimension].values;
  const std::vector<double> weights = marginal(dimension);
  double sum = 0.0, total = 0.0;
  for (size_t i = 0; i < values.size(); ++i) {
    sum += weights[i] * values[i];
    total += weights[i];
  }
  return sum / total;
}

double GridPosterior::standardDeviation(size_t dimension) const {
  const std::vector<double>& values = grid_.axes()[dimension].values;
  const std::vector<double> weights = marginal(dimension);
  const double centre = mean(dimension);
  double sum = 0.0;
  for (size_t i = 0; i < values.size(); ++i) {
    sum += weights[i] * (values[i] - centre) * (values[i] - centre);
  }
  return std::sqrt(sum);
}

double GridPosterior::mode(size_t dimension) const {
  const std::vector<double> weights = marginal(dimension);
  const auto best = std::max_element(weights.begin(), weights.end());
  return grid_.axes()[dimension].values[static_cast<size_t>(best - weights.begin())];
}

double GridPosterior::quantile(size_t dimension, double p) const {
  const GridAxis& axis = grid_.axes()[dimension];
  return clampToAxis(axis, Histogram(axis, marginal(dimension)).quantile(p));
}

CredibleInterval GridPosterior::equalTailed(size_t dimension, double level) const {
  const GridAxis& axis = grid_.axes()[dimension];
  const Histogram histogram(axis, marginal(dimension));
  return {clampToAxis(axis, histogram.quantile(0.5 * (1.0 - level))),
          clampToAxis(axis, histogram.quantile(0.5 * (1.0 + level)))};
}

CredibleInterval GridPosterior::highestDensity(size_t dimension, double level) const {
  const GridAxis& axis = grid_.axes()[dimension];
  const Histogram histogram(axis, marginal(dimension));
  // The length of [Q(a), Q(a + level)] is piecewise linear in a: shortest where one of the ends is a border.
  std::vector<double> starts = {0.0, 1.0 - level};
  for (double below : histogram.below) {
    if (below <= 1.0 - level) starts.push_back(below);
    if (below >= level) starts.push_back(std::min(below - level, 1.0 - level));
  }
  std::sort(starts.begin(), starts.end());
  CredibleInterval best;
  double shortest = std::numeric_limits<double>::infinity();
  for (double start : starts) {
    const double low = histogram.quantile(start), high = histogram.quantile(start + level);
    if (high - low < shortest) {
      shortest = high - low;
      best = {low, high};
    }
  }
  return {clampToAxis(axis, best.low), clampToAxis(axis, best.high)};
}

std::string GridPosterior::hash() const {
  return Sha256().update(logWeight_.data(), logWeight_.size() * sizeof(double)).hex();
}

}  // namespace limen::psychometrics
