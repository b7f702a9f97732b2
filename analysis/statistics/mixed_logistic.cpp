// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/mixed_logistic.h"

#include <ceres/first_order_function.h>
#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "analysis/statistics/detail/check.h"
#include "analysis/statistics/detail/laplace.h"
#include "analysis/statistics/distributions.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

constexpr double kEdge = 1e-4;             ///< of the scaled random effects: less is no spread
constexpr double kWidestDeviation = 50.0;  ///< of the scaled random effects; wider spreads are runaway fits

class Negative final : public ceres::FirstOrderFunction {
 public:
  explicit Negative(const LaplaceModel& model) : model_(model) {}
  bool Evaluate(const double* parameters, double* cost, double* gradient) const override {
    const Eigen::Map<const Eigen::VectorXd> at(parameters, model_.parameters());
    const LaplaceValue value = evaluateLaplace(model_, at);
    if (!value.settled || !std::isfinite(value.logLikelihood)) return false;
    *cost = -value.logLikelihood;
    if (gradient) Eigen::Map<Eigen::VectorXd>(gradient, model_.parameters()) = -value.gradient;
    return true;
  }
  int NumParameters() const override { return static_cast<int>(model_.parameters()); }

 private:
  const LaplaceModel& model_;
};

/// Minus the second derivatives, by central differences of the exact gradient.
Eigen::MatrixXd information(const LaplaceModel& model, const Eigen::VectorXd& at) {
  constexpr double kStep = 1e-4;
  Eigen::MatrixXd h(at.size(), at.size());
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    Eigen::VectorXd up = at, down = at;
    up(k) += kStep;
    down(k) -= kStep;
    h.col(k) = (evaluateLaplace(model, down).gradient - evaluateLaplace(model, up).gradient) / (2.0 * kStep);
  }
  return 0.5 * (h + h.transpose());
}

/// Inverse information of the fixed effects, with those entries of L beside them that are not on the edge.
/// Turning the sign of a column of L changes nothing, so that a column of zeros is uncoupled from all others:
/// leaving it out holds it fixed.
Eigen::MatrixXd covarianceOfCoefficients(const LaplaceModel& model, Eigen::VectorXd at) {
  const Eigen::Index p = model.fixed.cols();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < p; ++k) kept.push_back(k);
  if (model.random.cols() == 1) {
    if (std::abs(at(p)) >= kEdge) kept.push_back(p);
  } else if (std::abs(at(p)) >= kEdge) {
    kept.insert(kept.end(), {p, p + 1});
    if (std::abs(at(p + 2)) >= kEdge) kept.push_back(p + 2);
  } else {
    // Without spread of the intercept both entries of the slope do the same; one is enough.
    at(p + 2) = std::hypot(at(p + 1), at(p + 2));
    at(p) = at(p + 1) = 0.0;
    if (at(p + 2) >= kEdge) kept.push_back(p + 2);
  }
  const Eigen::MatrixXd all = information(model, at), h = all(kept, kept);
  const Eigen::LLT<Eigen::MatrixXd> factored(h);
  if (factored.info() != Eigen::Success)
    throw Error("the likelihood is flat at its maximum, errors cannot be told", "design");
  return factored.solve(Eigen::MatrixXd::Identity(h.rows(), h.cols())).topLeftCorner(p, p);
}

void check(const MixedLogisticData& data, const MixedLogisticOptions& options) {
  requireLevel(options.level);
  const size_t rows = data.trials.size(), columns = data.columns.size();
  requireAtLeast(rows, 1, "trials");
  requireAtLeast(columns, 1, "columns");
  requireSameLength(rows, "trials", data.successes.size(), "successes");
  requireSameLength(rows, "trials", data.groups.size(), "groups");
  if (data.design.size() != rows * columns)
    throw Error(fmt::format("{} values for {} rows of {} columns", data.design.size(), rows, columns),
                indexed("design", std::min(data.design.size(), rows * columns)));
  for (size_t i = 0; i < rows; ++i) {
    requireCounts(data.successes[i], data.trials[i], indexed("successes", i), true);
    for (size_t c = 0; c < columns; ++c)
      if (!std::isfinite(data.design[i * columns + c]))
        requireFinite(data.design[i * columns + c], fmt::format("design[{}][{}]", i, data.columns[c]));
  }
  if (options.random == RandomEffects::kInterceptAndSlope && options.slopeColumn >= columns)
    throw Error(fmt::format("column {} of {}", options.slopeColumn, columns), "slopeColumn");
}

/// Columns of length sqrt(rows) and orthogonal to one another, and what turns their coefficients back.
struct Whitened {
  Eigen::MatrixXd columns, back;
};

Whitened whiten(const MixedLogisticData& data) {
  const auto rows = static_cast<Eigen::Index>(data.trials.size()),
             columns = static_cast<Eigen::Index>(data.columns.size());
  Eigen::MatrixXd x(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index c = 0; c < columns; ++c) x(i, c) = data.design[static_cast<size_t>(i * columns + c)];
  // Of one length first, so that units do not decide about rank.
  Eigen::VectorXd lengths(columns);
  for (Eigen::Index c = 0; c < columns; ++c) {
    const double largest = x.col(c).cwiseAbs().maxCoeff();
    if (largest == 0.0)
      throw Error(fmt::format("column '{}' is 0 throughout", data.columns[static_cast<size_t>(c)]), "design",
                  "leave it out");
    lengths(c) = largest * (x.col(c) / largest).norm();
    x.col(c) /= lengths(c);
  }
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(columns, columns), q = x;
  for (Eigen::Index c = 0; c < columns; ++c) {
    // Gram and Schmidt, twice, which is enough for full orthogonality.
    for (int pass = 0; pass < 2; ++pass)
      for (Eigen::Index k = 0; k < c; ++k) {
        const double along = q.col(k).dot(q.col(c));
        r(k, c) += along;
        q.col(c) -= along * q.col(k);
      }
    r(c, c) = q.col(c).norm();
    if (r(c, c) < 1e-9)
      throw Error(
          fmt::format("column '{}' follows from those before it", data.columns[static_cast<size_t>(c)]),
          "design", "leave it out");
    q.col(c) /= r(c, c);
  }
  const double scale = std::sqrt(static_cast<double>(rows));
  Whitened w;
  w.columns = q * scale;
  // x = q r diag(lengths) and eta = q scale beta': beta = diag(1/lengths) r^-1 scale beta'.
  w.back = lengths.cwiseInverse().asDiagonal() *
           r.triangularView<Eigen::Upper>().solve(scale * Eigen::MatrixXd::Identity(columns, columns)).eval();
  return w;
}

/// Coefficients without random effects; refuses answers that the columns separate.
Eigen::VectorXd fitPooled(const LaplaceModel& model) {
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(model.fixed.cols());
  const auto logLikelihood = [&](const Eigen::VectorXd& at) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < model.fixed.rows(); ++i)
      sum += binomialLogChance(model.successes(i), model.trials(i), model.fixed.row(i).dot(at));
    return sum;
  };
  double value = logLikelihood(beta);
  for (int step = 0; step < 100; ++step) {
    const Eigen::VectorXd eta = model.fixed * beta;
    Eigen::VectorXd residual(eta.size()), weight(eta.size());
    for (Eigen::Index i = 0; i < eta.size(); ++i) {
      const double p = 1.0 / (1.0 + std::exp(-eta(i)));
      residual(i) = model.successes(i) - model.trials(i) * p;
      weight(i) = model.trials(i) * p * (1.0 - p);
    }
    const Eigen::MatrixXd h = model.fixed.transpose() * weight.asDiagonal() * model.fixed;
    const Eigen::VectorXd direction = h.ldlt().solve(model.fixed.transpose() * residual);
    if (!direction.allFinite()) break;
    // Along a direction that separates, Newton's steps stay about 1 long for ever.
    if (direction.cwiseAbs().maxCoeff() < 1e-8) return beta;
    double length = 1.0, after = logLikelihood(beta + direction);
    while (!(after >= value) && length > 1e-6) {
      length *= 0.5;
      after = logLikelihood(beta + length * direction);
    }
    beta += length * direction;
    value = after;
  }
  throw Error(
      "some combination of the columns separates the successes from the failures, estimates would be "
      "infinite",
      "design", "leave a column out or collect answers on both sides");
}

struct Maximum {
  Eigen::VectorXd at;
  double logLikelihood = -std::numeric_limits<double>::infinity();
};

Maximum maximise(const LaplaceModel& model, const Eigen::VectorXd& start) {
  Maximum maximum{start, 0.0};
  const ceres::GradientProblem problem(new Negative(model));
  ceres::GradientProblemSolver::Options options;
  options.logging_type = ceres::SILENT;
  options.line_search_direction_type = ceres::BFGS;
  options.max_num_iterations = 500;
  options.function_tolerance = 1e-15;
  options.gradient_tolerance = 1e-7;
  options.parameter_tolerance = 1e-12;
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(options, problem, maximum.at.data(), &summary);
  // A few Newton steps take off what the line search leaves.
  LaplaceValue value = evaluateLaplace(model, maximum.at);
  for (int step = 0; step < 5 && value.settled && value.gradient.norm() > 1e-9; ++step) {
    const Eigen::LLT<Eigen::MatrixXd> h(information(model, maximum.at));
    if (h.info() != Eigen::Success) break;
    const Eigen::VectorXd next = maximum.at + h.solve(value.gradient);
    const LaplaceValue after = evaluateLaplace(model, next);
    if (!after.settled || !(after.gradient.norm() < value.gradient.norm())) break;
    maximum.at = next;
    value = after;
  }
  maximum.logLikelihood = value.settled ? value.logLikelihood : -std::numeric_limits<double>::infinity();
  return maximum;
}

}  // namespace

MixedLogistic fitMixedLogistic(const MixedLogisticData& data, const MixedLogisticOptions& options) {
  check(data, options);
  const Whitened white = whiten(data);
  const auto rows = static_cast<Eigen::Index>(data.trials.size());
  const bool hasSlope = options.random == RandomEffects::kInterceptAndSlope;

  LaplaceModel model;
  model.fixed = white.columns;
  model.random = Eigen::MatrixXd::Ones(rows, hasSlope ? 2 : 1);
  double slopeScale = 1.0;
  if (hasSlope) {
    for (Eigen::Index i = 0; i < rows; ++i)
      model.random(i, 1) = data.design[static_cast<size_t>(i) * data.columns.size() + options.slopeColumn];
    slopeScale = model.random.col(1).cwiseAbs().maxCoeff();
    model.random.col(1) /= slopeScale;
    if ((model.random.col(1).array() == model.random(0, 1)).all())
      throw Error(fmt::format("column '{}' is constant, a random slope along it is a random intercept",
                              data.columns[options.slopeColumn]),
                  "slopeColumn");
  }
  model.successes.resize(rows);
  model.trials.resize(rows);
  std::map<size_t, std::vector<Eigen::Index>> rowsOfGroup;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto at = static_cast<size_t>(i);
    model.successes(i) = static_cast<double>(data.successes[at]);
    model.trials(i) = static_cast<double>(data.trials[at]);
    rowsOfGroup[data.groups[at]].push_back(i);
  }
  if (rowsOfGroup.size() < 2)
    throw Error("all rows belong to one group, so there is no spread over groups", "groups");
  for (const auto& [group, own] : rowsOfGroup) model.groups.push_back(own);

  const Eigen::VectorXd pooled = fitPooled(model);
  Maximum best;
  for (const double deviation : {1.0, 0.2, 3.0}) {
    Eigen::VectorXd start = Eigen::VectorXd::Zero(model.parameters());
    start.head(pooled.size()) = pooled;
    start(pooled.size()) = deviation;
    if (hasSlope) start(pooled.size() + 2) = deviation;
    const Maximum found = maximise(model, start);
    if (found.logLikelihood > best.logLikelihood + 1e-9) best = found;
  }
  if (!std::isfinite(best.logLikelihood)) throw Error("no maximum of the likelihood was found", "design");
  const LaplaceValue value = evaluateLaplace(model, best.at);
  const Eigen::MatrixXd lower = model.factor(best.at);
  if (lower.cwiseAbs().maxCoeff() > kWidestDeviation || !(value.gradient.cwiseAbs().maxCoeff() < 1e-3))
    throw Error(
        "the likelihood has no maximum within reach: the spread over groups or an effect grows without bound",
        "groups", "answers that agree within every group cannot tell its size; collect more");

  MixedLogistic result;
  const Eigen::MatrixXd sigma = lower * lower.transpose();
  result.interceptDeviation = std::sqrt(sigma(0, 0));
  if (hasSlope) {
    result.slopeDeviation = std::sqrt(sigma(1, 1)) / slopeScale;
    if (sigma(0, 0) > 1e-12 && sigma(1, 1) > 1e-12)
      result.correlation = std::clamp(sigma(0, 1) / std::sqrt(sigma(0, 0) * sigma(1, 1)), -1.0, 1.0);
  }
  const Eigen::Index p = pooled.size();
  result.singular = lower.diagonal().cwiseAbs().minCoeff() < kEdge;
  if (result.singular)
    result.note =
        hasSlope ? "the covariance over groups is singular (no spread, or a correlation of +-1); errors hold "
                   "fixed what is on that edge"
                 : "no spread over groups was found; errors hold it at 0";
  const Eigen::MatrixXd inverse = covarianceOfCoefficients(model, best.at);
  const Eigen::VectorXd beta = white.back * best.at.head(p);
  const Eigen::MatrixXd covariance = white.back * inverse * white.back.transpose();
  const double z = criticalZ(options.level);
  for (Eigen::Index c = 0; c < p; ++c) {
    FixedEffect effect{
        data.columns[static_cast<size_t>(c)], beta(c), std::sqrt(covariance(c, c)), 0.0, 1.0, {}};
    effect.z = effect.estimate / effect.standardError;
    effect.p = normalTwoSided(effect.z);
    effect.interval = around(effect.estimate, z * effect.standardError);
    result.fixed.push_back(effect);
  }
  size_t index = 0;
  for (const auto& [group, own] : rowsOfGroup) {
    const Eigen::VectorXd modes = lower * value.modes[index++];
    result.groups.push_back({group, modes(0), hasSlope ? modes(1) / slopeScale : 0.0});
  }
  result.logLikelihood = best.logLikelihood;
  result.aic = 2.0 * static_cast<double>(model.parameters()) - 2.0 * best.logLikelihood;
  return result;
}

}  // namespace limen::analysis
