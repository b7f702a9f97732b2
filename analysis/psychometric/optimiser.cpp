// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/psychometric/optimiser.h"

#include <ceres/first_order_function.h>
#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <ceres/version.h>

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <boost/version.hpp>
#include <cmath>

#include "analysis/psychometric/fit.h"

namespace limen::analysis {
namespace {

/// Nearer to a bound than this part of the range between them counts as at it.
constexpr double kAtBound = 1e-6;

struct Angles {
  const Objective& objective;
  const std::vector<double>& start;
  std::vector<size_t> varied;

  std::vector<double> x(const double* angles) const {
    std::vector<double> at = start;
    for (size_t i = 0; i < varied.size(); ++i) {
      const FreeParameter& free = objective.free()[varied[i]];
      const double s = std::sin(angles[i]);
      at[varied[i]] = std::clamp(free.low + (free.high - free.low) * s * s, free.low, free.high);
    }
    return at;
  }
};

class OnAngles final : public ceres::FirstOrderFunction {
 public:
  explicit OnAngles(const Angles& angles) : angles_(angles) {}
  bool Evaluate(const double* at, double* cost, double* gradient) const override {
    const std::vector<double> x = angles_.x(at);
    std::vector<double> full(gradient ? x.size() : 0);
    *cost = angles_.objective.evaluate(x.data(), gradient ? full.data() : nullptr);
    if (!std::isfinite(*cost)) return false;
    if (!gradient) return true;
    for (size_t i = 0; i < angles_.varied.size(); ++i) {
      const FreeParameter& free = angles_.objective.free()[angles_.varied[i]];
      gradient[i] = full[angles_.varied[i]] * (free.high - free.low) * std::sin(2.0 * at[i]);
      if (!std::isfinite(gradient[i])) return false;
    }
    return true;
  }
  int NumParameters() const override { return static_cast<int>(angles_.varied.size()); }

 private:
  const Angles& angles_;
};

/// Differences of the gradient for the parameters of `which`.
Eigen::MatrixXd curvature(const Objective& objective, const std::vector<double>& x,
                          const std::vector<size_t>& which) {
  const auto n = static_cast<Eigen::Index>(which.size());
  Eigen::MatrixXd h(n, n);
  std::vector<double> up(x.size()), down(x.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    const size_t j = which[static_cast<size_t>(i)];
    const FreeParameter& free = objective.free()[j];
    const double step = 1e-4 * std::min(free.scale, 1.0 * (free.high - free.low));
    std::vector<double> at = x;
    const double high = std::min(x[j] + step, free.high), low = std::max(x[j] - step, free.low);
    at[j] = high;
    objective.evaluate(at.data(), up.data());
    at[j] = low;
    objective.evaluate(at.data(), down.data());
    for (Eigen::Index k = 0; k < n; ++k) {
      const size_t m = which[static_cast<size_t>(k)];
      h(k, i) = (up[m] - down[m]) / (high - low);
    }
  }
  return 0.5 * (h + h.transpose());
}

void newton(const Objective& objective, const std::vector<bool>& held, Optimum& optimum) {
  std::vector<double> gradient(optimum.x.size());
  optimum.value = objective.evaluate(optimum.x.data(), gradient.data());
  for (int step = 0; step < 12; ++step) {
    // At a bound that the gradient presses against a parameter stays.
    std::vector<size_t> inside;
    std::vector<double> next = optimum.x;
    for (size_t j = 0; j < optimum.x.size(); ++j) {
      if (!held.empty() && held[j]) continue;
      const FreeParameter& free = objective.free()[j];
      const double near = kAtBound * (free.high - free.low);
      if (next[j] < free.low + near && gradient[j] > 0.0)
        next[j] = free.low;
      else if (next[j] > free.high - near && gradient[j] < 0.0)
        next[j] = free.high;
      else
        inside.push_back(j);
    }
    if (!inside.empty()) {
      const Eigen::MatrixXd h = curvature(objective, optimum.x, inside);
      Eigen::VectorXd move(h.rows());
      for (size_t i = 0; i < inside.size(); ++i) move[static_cast<Eigen::Index>(i)] = gradient[inside[i]];
      const Eigen::LLT<Eigen::MatrixXd> cholesky(h);
      cholesky.solveInPlace(move);
      const bool usable = h.allFinite() && cholesky.info() == Eigen::Success && move.allFinite();
      for (size_t i = 0; usable && i < inside.size(); ++i) {
        const FreeParameter& free = objective.free()[inside[i]];
        next[inside[i]] =
            std::clamp(next[inside[i]] - move[static_cast<Eigen::Index>(i)], free.low, free.high);
      }
    }
    if (next == optimum.x) return;
    std::vector<double> after(gradient.size());
    // Near the minimum values differ by rounding alone.
    const double most = optimum.value + 4e-15 * std::max(1.0, std::abs(optimum.value));
    const std::vector<double> full = next;
    double value = objective.evaluate(next.data(), after.data());
    for (double part = 0.25; !(value <= most) && part > 1e-3; part *= 0.25) {
      for (size_t j = 0; j < next.size(); ++j) next[j] = optimum.x[j] + part * (full[j] - optimum.x[j]);
      value = objective.evaluate(next.data(), after.data());
    }
    if (!(value <= most)) return;
    double change = 0.0;
    for (size_t j = 0; j < next.size(); ++j)
      change = std::max(change, std::abs(next[j] - optimum.x[j]) / objective.free()[j].scale);
    optimum.x = next;
    optimum.value = value;
    gradient = after;
    if (change < 1e-12) return;
  }
}

/// Ceres reports a line search that ended early through glog on stderr, whatever its own options say. What
/// such a search has reached is checked and refined here.
void silenceCeres() {
  static const bool done = [] {
    FLAGS_minloglevel = google::GLOG_ERROR;
    return true;
  }();
  (void)done;
}

}  // namespace

Optimum minimise(const Objective& objective, const std::vector<double>& start,
                 const std::vector<bool>& held) {
  Optimum optimum{start, objective.evaluate(start.data(), nullptr), std::vector<int>(start.size(), 0)};
  if (!std::isfinite(optimum.value)) return optimum;
  Angles angles{objective, start, {}};
  for (size_t j = 0; j < start.size(); ++j)
    if (held.empty() || !held[j]) angles.varied.push_back(j);
  if (angles.varied.empty()) return optimum;
  std::vector<double> at;
  for (const size_t j : angles.varied) {
    const FreeParameter& free = objective.free()[j];
    // At either end the angle has no slope.
    const double part = std::clamp((start[j] - free.low) / (free.high - free.low), 1e-3, 1.0 - 1e-3);
    at.push_back(std::asin(std::sqrt(part)));
  }
  const ceres::GradientProblem problem(new OnAngles(angles));
  ceres::GradientProblemSolver::Options options;
  options.logging_type = ceres::SILENT;
  options.line_search_direction_type = ceres::BFGS;
  options.max_num_iterations = 300;
  options.function_tolerance = 1e-12;
  options.gradient_tolerance = 1e-8;
  options.parameter_tolerance = 1e-10;
  silenceCeres();
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(options, problem, at.data(), &summary);
  const std::vector<double> found = angles.x(at.data());
  if (objective.evaluate(found.data(), nullptr) <= optimum.value) optimum.x = found;
  newton(objective, held, optimum);
  for (size_t j = 0; j < optimum.x.size(); ++j) {
    const FreeParameter& free = objective.free()[j];
    const double near = kAtBound * (free.high - free.low);
    optimum.atBound[j] = optimum.x[j] <= free.low + near ? -1 : optimum.x[j] >= free.high - near ? 1 : 0;
  }
  return optimum;
}

std::vector<double> secondDerivatives(const Objective& objective, const std::vector<double>& x) {
  std::vector<size_t> all(x.size());
  for (size_t j = 0; j < all.size(); ++j) all[j] = j;
  const Eigen::MatrixXd h = curvature(objective, x, all);
  return {h.data(), h.data() + h.size()};
}

std::vector<std::array<std::string, 2>> fitLibraries() {
  return {{"ceres", CERES_VERSION_STRING},
          {"eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                        std::to_string(EIGEN_MINOR_VERSION)},
          {"boost", BOOST_LIB_VERSION}};
}

}  // namespace limen::analysis
