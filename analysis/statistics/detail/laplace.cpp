// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/detail/laplace.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace limen::analysis {
namespace {

constexpr int kMostSteps = 100;

/// ln(1 + e^x)
double softPlus(double x) { return x > 0.0 ? x + std::log1p(std::exp(-x)) : std::log1p(std::exp(x)); }

struct Group {
  Eigen::MatrixXd fixed, random;  ///< rows of this group
  Eigen::VectorXd successes, trials;
};

/// Derivatives of the log-likelihood along the log odds of each row.
struct Slopes {
  Eigen::VectorXd residual, weight, skew;  ///< first, minus second, minus third
};

Slopes slopesAt(const Group& g, const Eigen::VectorXd& eta) {
  Slopes s{Eigen::VectorXd(eta.size()), Eigen::VectorXd(eta.size()), Eigen::VectorXd(eta.size())};
  for (Eigen::Index i = 0; i < eta.size(); ++i) {
    const double small = std::exp(-std::abs(eta(i))), p = (eta(i) > 0.0 ? 1.0 : small) / (1.0 + small);
    s.residual(i) = g.successes(i) - g.trials(i) * p;
    s.weight(i) = g.trials(i) * small / ((1.0 + small) * (1.0 + small));
    s.skew(i) = s.weight(i) * (1.0 - 2.0 * p);
  }
  return s;
}

/// The part of the penalised log-likelihood that depends on u.
double penalised(const Group& g, const Eigen::VectorXd& eta, const Eigen::VectorXd& u) {
  double sum = -0.5 * u.squaredNorm();
  for (Eigen::Index i = 0; i < eta.size(); ++i)
    sum += g.successes(i) * eta(i) - g.trials(i) * softPlus(eta(i));
  return sum;
}

struct Mode {
  Eigen::VectorXd u, eta;
  bool settled = false;
};

/// Newton's method with step halving; the penalised likelihood is strictly concave in u.
Mode findMode(const Group& g, const Eigen::VectorXd& offset, const Eigen::MatrixXd& loadings) {
  Mode m{Eigen::VectorXd::Zero(loadings.cols()), offset, false};
  double value = penalised(g, m.eta, m.u);
  for (int step = 0; step < kMostSteps; ++step) {
    const Slopes s = slopesAt(g, m.eta);
    const Eigen::VectorXd gradient = loadings.transpose() * s.residual - m.u;
    const Eigen::MatrixXd h = loadings.transpose() * s.weight.asDiagonal() * loadings +
                              Eigen::MatrixXd::Identity(loadings.cols(), loadings.cols());
    const Eigen::VectorXd direction = h.llt().solve(gradient);
    double length = 1.0;
    Eigen::VectorXd u = m.u + direction, eta = offset + loadings * u;
    double after = penalised(g, eta, u);
    while (!(after >= value - 1e-13 * std::abs(value)) && length > 1e-9) {
      length *= 0.5;
      u = m.u + length * direction;
      eta = offset + loadings * u;
      after = penalised(g, eta, u);
    }
    m.u = u;
    m.eta = eta;
    value = after;
    if (direction.cwiseAbs().maxCoeff() < 1e-10 * (1.0 + u.cwiseAbs().maxCoeff())) {
      m.settled = true;
      break;
    }
  }
  return m;
}

/// Entry (row, column) of L that a parameter behind the coefficients is.
std::pair<Eigen::Index, Eigen::Index> entryOf(Eigen::Index parameter) {
  return parameter == 0 ? std::pair<Eigen::Index, Eigen::Index>{0, 0}
                        : std::pair<Eigen::Index, Eigen::Index>{1, parameter - 1};
}

}  // namespace

Eigen::MatrixXd LaplaceModel::factor(const Eigen::VectorXd& at) const {
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(random.cols(), random.cols());
  for (Eigen::Index k = fixed.cols(); k < parameters(); ++k) {
    const auto [row, column] = entryOf(k - fixed.cols());
    lower(row, column) = at(k);
  }
  return lower;
}

double binomialLogChance(double successes, double trials, double eta) {
  const double coefficient = trials == 1.0 ? 0.0
                                           : std::lgamma(trials + 1.0) - std::lgamma(successes + 1.0) -
                                                 std::lgamma(trials - successes + 1.0);
  return coefficient + successes * eta - trials * softPlus(eta);
}

LaplaceValue evaluateLaplace(const LaplaceModel& model, const Eigen::VectorXd& parameters) {
  const Eigen::Index coefficients = model.fixed.cols(), effects = model.random.cols();
  const Eigen::MatrixXd lower = model.factor(parameters);
  LaplaceValue result;
  result.gradient = Eigen::VectorXd::Zero(model.parameters());
  for (const std::vector<Eigen::Index>& rows : model.groups) {
    const Group g{model.fixed(rows, Eigen::all), model.random(rows, Eigen::all), model.successes(rows),
                  model.trials(rows)};
    const Eigen::MatrixXd loadings = g.random * lower;  // d eta / d u
    const Mode mode = findMode(g, g.fixed * parameters.head(coefficients), loadings);
    result.settled = result.settled && mode.settled;
    result.modes.push_back(mode.u);
    const Slopes s = slopesAt(g, mode.eta);
    const Eigen::MatrixXd h =
        loadings.transpose() * s.weight.asDiagonal() * loadings + Eigen::MatrixXd::Identity(effects, effects);
    const Eigen::LLT<Eigen::MatrixXd> factored(h);
    const Eigen::MatrixXd inverse = factored.solve(Eigen::MatrixXd::Identity(effects, effects));

    for (Eigen::Index i = 0; i < mode.eta.size(); ++i)
      result.logLikelihood += binomialLogChance(g.successes(i), g.trials(i), mode.eta(i));
    const Eigen::MatrixXd root = factored.matrixL();
    result.logLikelihood -= 0.5 * mode.u.squaredNorm() + root.diagonal().array().log().sum();

    for (Eigen::Index k = 0; k < model.parameters(); ++k) {
      Eigen::VectorXd direct;  // d eta / d parameter with u held
      Eigen::MatrixXd loadingChange = Eigen::MatrixXd::Zero(g.random.rows(), effects);
      if (k < coefficients) {
        direct = g.fixed.col(k);
      } else {
        const auto [row, column] = entryOf(k - coefficients);
        loadingChange.col(column) = g.random.col(row);
        direct = loadingChange * mode.u;
      }
      // How the mode moves: H du = d(gradient in u).
      const Eigen::VectorXd modeChange = inverse * (loadingChange.transpose() * s.residual -
                                                    loadings.transpose() * s.weight.cwiseProduct(direct));
      const Eigen::VectorXd weightChange = s.skew.cwiseProduct(direct + loadings * modeChange);
      const Eigen::MatrixXd half = loadingChange.transpose() * s.weight.asDiagonal() * loadings;
      const Eigen::MatrixXd change =
          loadings.transpose() * weightChange.asDiagonal() * loadings + half + half.transpose();
      result.gradient(k) += s.residual.dot(direct) - 0.5 * (inverse * change).trace();
    }
  }
  return result;
}

}  // namespace limen::analysis
