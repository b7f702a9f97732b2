// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/pairwise_scaling.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "analysis/statistics/detail/check.h"
#include "analysis/statistics/detail/draw.h"
#include "analysis/statistics/distributions.h"
#include "analysis/statistics/log_math.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

constexpr int kMostNewtonSteps = 200;

/// Judgements of two items, `first` < `second`.
struct Pair {
  Eigen::Index first = 0, second = 0;
  double wins = 0.0, trials = 0.0;  ///< wins of the first
};

struct Fit {
  Eigen::VectorXd values;
  Eigen::MatrixXd covariance;
  bool penalised = false;
};

/// ln P(preferred) at difference x, its derivative and minus its second.
struct LogChance {
  double value = 0.0, slope = 0.0, curvature = 0.0;
};

LogChance logChance(PairwiseModel model, double x) {
  if (model == PairwiseModel::kBradleyTerry) {
    const double other = 1.0 / (1.0 + std::exp(x));
    return {x > 0.0 ? -std::log1p(std::exp(-x)) : x - std::log1p(std::exp(x)), other,
            std::exp(-std::abs(x)) / std::pow(1.0 + std::exp(-std::abs(x)), 2.0)};
  }
  const double value = logNormalLower(x),
               mills = std::exp(-0.5 * x * x - 0.5 * std::log(8.0 * std::atan(1.0)) - value);
  return {value, mills, mills * (mills + x)};
}

/// Items that can be reached from item 0 along judged pairs, or along wins from winner to loser, or the other
/// way.
enum class Along { kJudged, kWins, kLosses };
std::vector<bool> reach(const std::vector<Pair>& pairs, size_t items, Along along) {
  std::vector<std::vector<size_t>> next(items);
  for (const Pair& p : pairs) {
    const auto a = static_cast<size_t>(p.first), b = static_cast<size_t>(p.second);
    const bool aWins = p.wins > 0.0, bWins = p.wins < p.trials;
    if (along == Along::kJudged || (along == Along::kWins ? aWins : bWins)) next[a].push_back(b);
    if (along == Along::kJudged || (along == Along::kWins ? bWins : aWins)) next[b].push_back(a);
  }
  std::vector<bool> reached(items, false);
  std::vector<size_t> open{0};
  reached[0] = true;
  while (!open.empty()) {
    const size_t item = open.back();
    open.pop_back();
    for (const size_t other : next[item])
      if (!reached[other]) {
        reached[other] = true;
        open.push_back(other);
      }
  }
  return reached;
}

/// How messages call an item.
template <class Index>
std::string nameOf(const PairwiseOptions& options, Index item) {
  return options.names.empty() ? std::to_string(item) : "'" + options.names[static_cast<size_t>(item)] + "'";
}

/// Why the scale has no finite estimate; empty if it has one.
std::string whyUnbounded(const std::vector<Pair>& pairs, size_t items, const PairwiseOptions& options) {
  const PairwiseModel model = options.model;
  if (model == PairwiseModel::kThurstoneLeastSquares) {
    for (const Pair& p : pairs)
      if (p.wins == 0.0 || p.wins == p.trials)
        return fmt::format("items {} and {} were judged unanimously, which puts them infinitely far apart",
                           nameOf(options, p.first), nameOf(options, p.second));
    return {};
  }
  for (const Along along : {Along::kWins, Along::kLosses}) {
    const std::vector<bool> reached = reach(pairs, items, along);
    const auto missing = std::find(reached.begin(), reached.end(), false);
    if (missing != reached.end())
      return fmt::format(
          "no chain of preferences leads from item {} to item {}, which puts them infinitely far apart",
          nameOf(options, along == Along::kWins ? 0 : missing - reached.begin()),
          nameOf(options, along == Along::kWins ? missing - reached.begin() : 0));
  }
  return {};
}

/// Inverse on the subspace of vectors that sum to 0 of a matrix that maps constants to 0 (or to a multiple).
Eigen::MatrixXd invertCentred(const Eigen::MatrixXd& h) {
  const auto n = static_cast<double>(h.rows());
  const double scale = h.trace() / n;
  const Eigen::MatrixXd centre = Eigen::MatrixXd::Identity(h.rows(), h.cols()).array() - 1.0 / n;
  const Eigen::MatrixXd full = centre * h * centre + Eigen::MatrixXd::Constant(h.rows(), h.cols(), scale / n);
  return centre * full.ldlt().solve(centre);
}

Fit fitLeastSquares(const std::vector<Pair>& pairs, size_t items, bool penalise) {
  const auto n = static_cast<Eigen::Index>(items);
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(n, n), spread = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  for (const Pair& p : pairs) {
    const double chance = penalise ? (p.wins + 0.5) / (p.trials + 1.0) : p.wins / p.trials;
    const double z = normalQuantile(chance), density = normalDensity(z);
    const double variance = chance * (1.0 - chance) / (p.trials * density * density);
    Eigen::VectorXd contrast = Eigen::VectorXd::Zero(n);
    contrast(p.first) = 1.0;
    contrast(p.second) = -1.0;
    laplacian += contrast * contrast.transpose();
    spread += variance * contrast * contrast.transpose();
    right += z * contrast;
  }
  const Eigen::MatrixXd inverse = invertCentred(laplacian);
  return {inverse * right, inverse * spread * inverse, penalise};
}

/// Newton's method with step halving on a concave function.
Fit fitLikelihood(const std::vector<Pair>& pairs, size_t items, PairwiseModel model, double precision) {
  const auto n = static_cast<Eigen::Index>(items);
  Eigen::VectorXd s = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd hessian;
  const auto objective = [&](const Eigen::VectorXd& at) {
    double sum = -0.5 * precision * at.squaredNorm();
    for (const Pair& p : pairs) {
      const double x = at(p.first) - at(p.second);
      if (p.wins > 0.0) sum += p.wins * logChance(model, x).value;
      if (p.wins < p.trials) sum += (p.trials - p.wins) * logChance(model, -x).value;
    }
    return sum;
  };
  double value = objective(s);
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    Eigen::VectorXd gradient = -precision * s;
    hessian = precision * Eigen::MatrixXd::Identity(n, n);
    for (const Pair& p : pairs) {
      const double x = s(p.first) - s(p.second);
      const LogChance won = logChance(model, x), lost = logChance(model, -x);
      const double losses = p.trials - p.wins;
      const double slope = p.wins * won.slope - losses * lost.slope;
      const double curvature = p.wins * won.curvature + losses * lost.curvature;
      gradient(p.first) += slope;
      gradient(p.second) -= slope;
      hessian(p.first, p.first) += curvature;
      hessian(p.second, p.second) += curvature;
      hessian(p.first, p.second) -= curvature;
      hessian(p.second, p.first) -= curvature;
    }
    const Eigen::VectorXd direction = invertCentred(hessian) * gradient;
    const double promise = gradient.dot(direction);
    // With very unequal counts rounding may keep the step from shrinking further; a promised gain so small is
    // a step of some 1e-5 standard errors.
    const bool settled = direction.cwiseAbs().maxCoeff() < 1e-11 * (1.0 + s.cwiseAbs().maxCoeff());
    if (settled || (step > 30 && promise < 1e-10)) return {s, invertCentred(hessian), precision > 0.0};
    double length = 1.0;
    Eigen::VectorXd next = s + direction;
    double after = objective(next);
    while (!(after >= value + 1e-4 * length * promise - 1e-12 * std::abs(value)) && length > 1e-10) {
      length *= 0.5;
      next = s + length * direction;
      after = objective(next);
    }
    s = next.array() - next.mean();
    value = after;
  }
  throw Error("the scale did not settle", "wins", "penalise it, or judge more pairs");
}

Fit fit(const std::vector<Pair>& pairs, size_t items, const PairwiseOptions& options, bool penalise) {
  if (options.model == PairwiseModel::kThurstoneLeastSquares) return fitLeastSquares(pairs, items, penalise);
  return fitLikelihood(pairs, items, options.model,
                       penalise ? 1.0 / (options.priorDeviation * options.priorDeviation) : 0.0);
}

std::vector<Pair> pairsOf(const std::vector<int64_t>& wins, size_t items, const PairwiseOptions& options) {
  if (!options.names.empty() && options.names.size() != items)
    throw Error(fmt::format("{} names for {} items", options.names.size(), items), "names");
  if (items < 2) throw Error(fmt::format("{} items, needs at least 2", items), "items");
  if (wins.size() % items != 0 || wins.size() / items != items)
    throw Error(fmt::format("{} counts for {} items", wins.size(), items), indexed("wins", wins.size()),
                "give one for each ordered pair");
  for (size_t i = 0; i < wins.size(); ++i) {
    const std::string where = fmt::format("wins[{}][{}]", i / items, i % items);
    if (wins[i] < 0) throw Error(fmt::format("a count of {}, a count is not negative", wins[i]), where);
    if (i / items == i % items && wins[i] != 0)
      throw Error("an item is not compared with itself", where, "leave the diagonal 0");
  }
  std::vector<Pair> pairs;
  for (size_t i = 0; i < items; ++i)
    for (size_t j = i + 1; j < items; ++j) {
      const auto w = static_cast<double>(wins[i * items + j]), l = static_cast<double>(wins[j * items + i]);
      if (w + l > 0.0)
        pairs.push_back({static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j), w, w + l});
    }
  const std::vector<bool> reached = reach(pairs, items, Along::kJudged);
  const auto missing = std::find(reached.begin(), reached.end(), false);
  if (missing != reached.end())
    throw Error(fmt::format("items {} and {} are not connected by any chain of judged pairs",
                            nameOf(options, 0), nameOf(options, missing - reached.begin())),
                "wins", "scale the parts one by one, or judge a pair that joins them");
  return pairs;
}

void judgeFit(PairwiseScale& scale, const std::vector<Pair>& pairs, PairwiseModel model) {
  const auto term = [](double count, double expected) {
    return count > 0.0 ? count * std::log(count / expected) : 0.0;
  };
  for (const Pair& p : pairs) {
    const double x = scale.values[static_cast<size_t>(p.first)] - scale.values[static_cast<size_t>(p.second)];
    const double losses = p.trials - p.wins, lnWin = logChance(model, x).value,
                 lnLoss = logChance(model, -x).value;
    if (p.wins > 0.0) scale.logLikelihood += p.wins * lnWin;
    if (losses > 0.0) scale.logLikelihood += losses * lnLoss;
    const double win = std::exp(lnWin), loss = std::exp(lnLoss);
    scale.deviance += 2.0 * (term(p.wins, p.trials * win) + term(losses, p.trials * loss));
    scale.pearson += std::pow(p.wins - p.trials * win, 2.0) / (p.trials * win * loss);
  }
  scale.deviance = std::max(0.0, scale.deviance);
  scale.pairsJudged = pairs.size();
  scale.df = pairs.size() - (scale.values.size() - 1);
  if (scale.df == 0 || scale.penalised) return;
  scale.devianceP = chiSquaredUpper(scale.deviance, static_cast<double>(scale.df));
  scale.pearsonP = chiSquaredUpper(scale.pearson, static_cast<double>(scale.df));
}

void bootstrap(PairwiseScale& scale, const std::vector<Pair>& pairs, size_t items,
               const PairwiseOptions& options) {
  std::mt19937_64 random(options.seed);
  for (int r = 0; r < options.resamples; ++r) {
    std::vector<Pair> sample = pairs;
    for (Pair& p : sample)
      if (p.wins > 0.0 && p.wins < p.trials)
        p.wins = static_cast<double>(
            binomialAt(drawUnit(random), std::llround(p.trials), p.wins / p.trials, 1.0 - p.wins / p.trials));
    const bool penalise = scale.penalised || !whyUnbounded(sample, items, options).empty();
    scale.penalisedResamples += penalise ? 1 : 0;
    const Fit again = fit(sample, items, options, penalise);
    scale.bootstrapValues.emplace_back(again.values.begin(), again.values.end());
  }
}

}  // namespace

PairwiseScale scalePairs(const std::vector<int64_t>& wins, size_t items, const PairwiseOptions& options) {
  if (!(options.priorDeviation > 0.0 && std::isfinite(options.priorDeviation)))
    throw Error(fmt::format("{} is no standard deviation", options.priorDeviation), "priorDeviation",
                "give one above 0");
  if (options.resamples < 0) throw Error(fmt::format("{} resamples", options.resamples), "resamples");
  const std::vector<Pair> pairs = pairsOf(wins, items, options);
  const std::string why = whyUnbounded(pairs, items, options);
  if (!why.empty() && options.unbounded == UnboundedScale::kRefuse)
    throw Error(why, "wins", "collect more judgements, leave the item out, or ask for a penalised scale");

  const Fit result = fit(pairs, items, options, !why.empty());
  PairwiseScale scale;
  scale.penalised = !why.empty();
  if (scale.penalised)
    scale.note =
        why + (options.model == PairwiseModel::kThurstoneLeastSquares
                   ? "; proportions were taken as (k + 1/2) / (n + 1)"
                   : fmt::format("; held together by a penalty, a normal prior of standard deviation {}",
                                 options.priorDeviation));
  for (Eigen::Index i = 0; i < result.values.size(); ++i) {
    const double value = result.values(i), error = std::sqrt(std::max(0.0, result.covariance(i, i)));
    scale.values.push_back(value);
    scale.standardErrors.push_back(error);
    for (Eigen::Index j = 0; j < result.values.size(); ++j)
      scale.covariance.push_back(result.covariance(i, j));
  }
  judgeFit(scale, pairs, options.model);
  if (options.resamples > 0) bootstrap(scale, pairs, items, options);
  return scale;
}

double predictPreference(PairwiseModel model, double difference) {
  return std::exp(logChance(model, difference).value);
}

}  // namespace limen::analysis
