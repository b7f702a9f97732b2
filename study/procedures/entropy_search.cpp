// SPDX-License-Identifier: BSD-3-Clause
#include "study/procedures/entropy_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "experiments/base/error.h"

namespace limen::study {
namespace {

constexpr size_t kMostBytes = size_t{1} << 30;

double timesLog(double x) { return x > 0.0 ? x * std::log(x) : 0.0; }

// Sum of products in four interleaved parts: a fixed order that the compiler can still vectorise.
double dot(const double* a, const double* b, size_t n) {
  double sums[4] = {0.0, 0.0, 0.0, 0.0};
  size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    for (size_t k = 0; k < 4; ++k) sums[k] += a[i + k] * b[i + k];
  }
  for (; i < n; ++i) sums[0] += a[i] * b[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace

EntropySearch::EntropySearch(const ModelSettings& settings, const std::string& where)
    : grid_(settings.stimulus), outcomes_(static_cast<size_t>(settings.model->outcomes())) {
  const psychometrics::ProductGrid parameters(settings.parameters);
  points_ = parameters.size();
  const bool nuisance =
      std::find(settings.nuisance.begin(), settings.nuisance.end(), true) != settings.nuisance.end();
  const size_t rows = outcomes_ + (nuisance ? 0 : 1);
  const double bytes =
      8.0 * static_cast<double>(grid_.size()) * static_cast<double>(points_) * static_cast<double>(rows);
  if (bytes > static_cast<double>(kMostBytes)) {
    throw Error("the table of " + std::to_string(grid_.size()) + " stimuli, " + std::to_string(points_) +
                    " parameter points and " + std::to_string(outcomes_) + " outcomes needs " +
                    std::to_string(static_cast<long long>(bytes / 1048576.0)) + " MiB",
                where, "use coarser grids: at most 1024 MiB");
  }
  likelihood_.resize(grid_.size() * outcomes_ * points_);
  if (!nuisance) answerEntropy_.resize(grid_.size() * points_);
  std::vector<double> logs(outcomes_);
  for (size_t point = 0; point < points_; ++point) {
    const std::vector<double> values = parameters.valuesOf(point);
    for (size_t s = 0; s < grid_.size(); ++s) {
      settings.logProbabilities(grid_.valuesOf(s), values.data(), logs.data());
      double entropy = 0.0;
      for (size_t o = 0; o < outcomes_; ++o) {
        const double likelihood = std::exp(logs[o]);
        likelihood_[(s * outcomes_ + o) * points_ + point] = likelihood;
        entropy -= likelihood > 0.0 ? likelihood * logs[o] : 0.0;
      }
      if (!nuisance) answerEntropy_[s * points_ + point] = entropy;
    }
  }
  if (!nuisance) return;
  ofInterest_.resize(points_);
  for (size_t point = 0; point < points_; ++point) {
    size_t number = 0;
    interestPoints_ = 1;
    for (size_t d = 0; d < settings.parameters.size(); ++d) {
      if (settings.nuisance[d]) continue;
      number = number * settings.parameters[d].size() + parameters.indexOf(point, d);
      interestPoints_ *= settings.parameters[d].size();
    }
    ofInterest_[point] = number;
  }
}

std::vector<double> EntropySearch::expectedEntropies(const psychometrics::GridPosterior& posterior) const {
  assert(posterior.size() == points_);
  const std::vector<double>& p = posterior.probability();
  const double entropy = posterior.entropy();
  std::vector<double> out(grid_.size());
  for (size_t s = 0; s < grid_.size(); ++s) {
    const double* likelihood = likelihood_.data() + s * outcomes_ * points_;
    if (!ofInterest_.empty()) {
      out[s] = withNuisance(likelihood, p);
      continue;
    }
    double outcomes = 0.0;
    for (size_t o = 0; o < outcomes_; ++o)
      outcomes += timesLog(dot(p.data(), likelihood + o * points_, points_));
    out[s] = entropy + outcomes + dot(p.data(), answerEntropy_.data() + s * points_, points_);
  }
  return out;
}

double EntropySearch::withNuisance(const double* likelihood, const std::vector<double>& probability) const {
  std::vector<double> marginal(interestPoints_);
  double expected = 0.0;
  for (size_t o = 0; o < outcomes_; ++o) {
    std::fill(marginal.begin(), marginal.end(), 0.0);
    const double* row = likelihood + o * points_;
    for (size_t i = 0; i < points_; ++i) marginal[ofInterest_[i]] += probability[i] * row[i];
    double total = 0.0;
    for (double m : marginal) {
      total += m;
      expected -= timesLog(m);
    }
    expected += timesLog(total);
  }
  return expected;
}

std::vector<size_t> lowestEntropies(const std::vector<double>& entropies, size_t count, double tolerance) {
  std::vector<size_t> out;
  std::vector<bool> taken(entropies.size(), false);
  while (out.size() < std::min(count, entropies.size())) {
    double lowest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < entropies.size(); ++i) {
      if (!taken[i]) lowest = std::min(lowest, entropies[i]);
    }
    const double limit = lowest + tolerance * (std::abs(lowest) + 0.01);
    size_t first = 0;
    while (taken[first] || entropies[first] > limit) ++first;
    taken[first] = true;
    out.push_back(first);
  }
  return out;
}

size_t lowestEntropy(const std::vector<double>& entropies, double tolerance) {
  return lowestEntropies(entropies, 1, tolerance).front();
}

}  // namespace limen::study
