// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/repeated_measures_anova.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analysis/statistics/detail/check.h"
#include "analysis/statistics/distributions.h"
#include "analysis/statistics/multiple_comparisons.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Number of cells; refuses designs that cannot be tested.
size_t cellsOf(const std::vector<WithinFactor>& factors, size_t subjects) {
  if (factors.empty()) throw Error("no factor, so there is nothing to compare", "factors");
  if (subjects < 2)
    throw Error(fmt::format("{} subjects, needs at least 2: effects are tested against how subjects differ",
                            subjects),
                "subjects");
  size_t cells = 1;
  for (size_t i = 0; i < factors.size(); ++i) {
    if (factors[i].levels < 2)
      throw Error(
          fmt::format("factor '{}' has {} levels, needs at least 2", factors[i].name, factors[i].levels),
          indexed("factors", i), "leave it out");
    if (cells > std::numeric_limits<size_t>::max() / subjects / factors[i].levels)
      throw Error("more cells than can be counted", indexed("factors", i));
    cells *= factors[i].levels;
  }
  return cells;
}

size_t check(const RepeatedMeasures& data) {
  const size_t cells = cellsOf(data.factors, data.subjects), expected = cells * data.subjects;
  if (data.values.size() != expected)
    throw Error(fmt::format("{} values for {} subjects in {} cells, which make {}", data.values.size(),
                            data.subjects, cells, expected),
                indexed("values", std::min(data.values.size(), expected)),
                "give one value for each subject and cell");
  requireFinite(data.values, "values");
  return cells;
}

/// Rows: the mean, then Helmert contrasts, all of length 1 and orthogonal. Any orthonormal choice gives the
/// same sums of squares, W and epsilons.
Eigen::MatrixXd orthonormalContrasts(size_t levels) {
  const auto k = static_cast<Eigen::Index>(levels);
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(k, k);
  q.row(0).setConstant(1.0 / std::sqrt(static_cast<double>(k)));
  for (Eigen::Index i = 1; i < k; ++i) {
    const double scale = 1.0 / std::sqrt(static_cast<double>(i * (i + 1)));
    q.row(i).head(i).setConstant(scale);
    q(i, i) = -static_cast<double>(i) * scale;
  }
  return q;
}

/// Cells of one subject into contrasts: along each factor in turn.
std::vector<double> transform(std::vector<double> cells, const std::vector<Eigen::MatrixXd>& contrasts) {
  size_t stride = cells.size();
  for (const Eigen::MatrixXd& q : contrasts) {
    const auto levels = static_cast<size_t>(q.rows());
    stride /= levels;
    Eigen::VectorXd line(q.rows());
    for (size_t base = 0; base < cells.size(); ++base) {
      if (base / stride % levels != 0) continue;
      for (size_t i = 0; i < levels; ++i) line(static_cast<Eigen::Index>(i)) = cells[base + i * stride];
      line = (q * line).eval();
      for (size_t i = 0; i < levels; ++i) cells[base + i * stride] = line(static_cast<Eigen::Index>(i));
    }
  }
  return cells;
}

/// Bit i is set where factor i takes part in the contrast.
size_t maskOf(size_t cell, const std::vector<WithinFactor>& factors) {
  size_t mask = 0;
  for (size_t i = factors.size(); i-- > 0;) {
    if (cell % factors[i].levels != 0) mask |= size_t{1} << i;
    cell /= factors[i].levels;
  }
  return mask;
}

double mauchlyP(double w, double d, double subjectDf) {
  const double rho = 1.0 - (2.0 * d * d + d + 2.0) / (6.0 * subjectDf * d);
  const double w2 = (d + 2.0) * (d - 1.0) * (d - 2.0) * (2.0 * d * d * d + 6.0 * d * d + 3.0 * d + 2.0) /
                    (288.0 * std::pow(subjectDf * d * rho, 2.0));
  const double z = std::max(0.0, -subjectDf * rho * std::log(w)), df = d * (d + 1.0) / 2.0 - 1.0;
  const double first = chiSquaredUpper(z, df), second = chiSquaredUpper(z, df + 4.0);
  return std::clamp(first + w2 * (second - first), 0.0, 1.0);
}

Sphericity sphericityOf(const Eigen::MatrixXd& covariance, size_t subjects, const AnovaEffect& effect) {
  const double d = effect.df, n = static_cast<double>(subjects);
  Sphericity s;
  const double trace = covariance.trace(), traceOfSquare = covariance.squaredNorm();
  s.greenhouseGeisser = std::clamp(trace * trace / (d * traceOfSquare), 1.0 / d, 1.0);
  const double e = d * s.greenhouseGeisser, denominator = d * (n - 1.0 - e), numerator = n * e - 2.0;
  // Two subjects leave 0 / 0; the lower bound is what is known then.
  if (denominator > 1e-9 * d)
    s.huynhFeldt = std::min(1.0, numerator / denominator);
  else
    s.huynhFeldt = numerator > 1e-9 ? 1.0 : s.greenhouseGeisser;
  s.huynhFeldt = std::max(s.huynhFeldt, 1.0 / d);

  const double subjectDf = n - 1.0;
  const double rho = 1.0 - (2.0 * d * d + d + 2.0) / (6.0 * subjectDf * d);
  if (subjectDf >= d) {
    const Eigen::LDLT<Eigen::MatrixXd> factored(covariance / (trace / d));
    double w = 1.0;
    for (Eigen::Index i = 0; i < covariance.rows(); ++i) w *= std::max(0.0, factored.vectorD()(i));
    s.mauchlyW = std::min(w, 1.0);
    // The expansion needs a positive rho; with W = 0 the hypothesis is out of the question.
    if (w == 0.0)
      s.mauchlyP = 0.0;
    else if (rho > 0.0)
      s.mauchlyP = mauchlyP(*s.mauchlyW, d, subjectDf);
  }
  s.pGreenhouseGeisser = fUpper(*effect.f, s.greenhouseGeisser * d, s.greenhouseGeisser * effect.dfError);
  s.pHuynhFeldt = fUpper(*effect.f, s.huynhFeldt * d, s.huynhFeldt * effect.dfError);
  return s;
}

Interval etaInterval(double f, double df, double dfError, double level) {
  const double tail = (1.0 - level) / 2.0;
  const auto share = [&](double p) {
    const double noncentrality = noncentralityOfF(f, df, dfError, p);
    return noncentrality / (noncentrality + df + dfError + 1.0);
  };
  return {share(1.0 - tail), share(tail)};
}

void testEffect(AnovaEffect& effect, const Eigen::MatrixXd& contrasts, double noise, double level) {
  const auto n = static_cast<double>(contrasts.rows());
  const Eigen::RowVectorXd mean = contrasts.colwise().mean();
  const Eigen::MatrixXd residual = contrasts.rowwise() - mean;
  effect.df = static_cast<double>(contrasts.cols());
  effect.dfError = effect.df * (n - 1.0);
  effect.sumOfSquares = n * mean.squaredNorm();
  effect.errorSumOfSquares = residual.squaredNorm();
  const double zero = noise * effect.df * n;
  if (effect.sumOfSquares <= zero) effect.sumOfSquares = 0.0;
  if (effect.errorSumOfSquares <= zero) effect.errorSumOfSquares = 0.0;

  if (effect.errorSumOfSquares == 0.0) {
    if (effect.sumOfSquares == 0.0) {
      effect.note = "neither the effect nor its variation over subjects differs from zero: F is undefined";
      return;
    }
    effect.f = kInfinity;
    effect.p = 0.0;
    effect.partialEtaSquared = 1.0;
    effect.note = "all subjects show the same effect, the error variance is zero: F is infinite";
    return;
  }
  effect.f = effect.sumOfSquares / effect.df / (effect.errorSumOfSquares / effect.dfError);
  effect.p = fUpper(*effect.f, effect.df, effect.dfError);
  effect.partialEtaSquared = effect.sumOfSquares / (effect.sumOfSquares + effect.errorSumOfSquares);
  try {
    effect.partialEtaSquaredInterval = etaInterval(*effect.f, effect.df, effect.dfError, level);
  } catch (const std::runtime_error&) {
    effect.note = "F is too large for an interval of partial eta squared";
  }
  if (contrasts.cols() > 1)
    effect.sphericity = sphericityOf(residual.transpose() * residual / (n - 1.0),
                                     static_cast<size_t>(contrasts.rows()), effect);
}

}  // namespace

RepeatedMeasures averageCells(const std::vector<WithinFactor>& factors, size_t subjects,
                              const std::vector<CellObservation>& observations) {
  const size_t cells = cellsOf(factors, subjects);
  if (cells * subjects / 1000 > observations.size())
    throw Error(fmt::format("{} observations cannot fill {} cells of {} subjects", observations.size(), cells,
                            subjects),
                "observations", "leave out subjects or levels that were not fully measured");
  RepeatedMeasures data{factors, subjects, std::vector<double>(cells * subjects, 0.0), false};
  std::vector<double> weights(cells * subjects, 0.0);
  for (size_t i = 0; i < observations.size(); ++i) {
    const CellObservation& o = observations[i];
    const std::string where = indexed("observations", i);
    requireFinite(o.value, where);
    requireFinite(o.weight, where);
    if (!(o.weight > 0.0)) throw Error(fmt::format("a weight of {}", o.weight), where);
    if (o.subject >= subjects) throw Error(fmt::format("subject {} of {}", o.subject, subjects), where);
    requireSameLength(factors.size(), "factors", o.levels.size(), where + ".levels");
    size_t cell = o.subject;
    for (size_t f = 0; f < factors.size(); ++f) {
      if (o.levels[f] >= factors[f].levels)
        throw Error(fmt::format("level {} of factor '{}', which has {}", o.levels[f], factors[f].name,
                                factors[f].levels),
                    where);
      cell = cell * factors[f].levels + o.levels[f];
    }
    data.values[cell] += o.value * o.weight;
    weights[cell] += o.weight;
  }
  for (size_t cell = 0; cell < weights.size(); ++cell) {
    if (weights[cell] == 0.0) {
      std::string levels;
      for (size_t f = factors.size(), rest = cell; f-- > 0; rest /= factors[f].levels)
        levels = fmt::format("{} {}{}{}", factors[f].name, rest % factors[f].levels,
                             levels.empty() ? "" : ", ", levels);
      throw Error(fmt::format("subject {} has no observation at {}", cell / cells, levels), "observations",
                  "leave out the subject or the level");
    }
    data.values[cell] /= weights[cell];
    if (weights[cell] != weights[0]) data.unequalReplicates = true;
  }
  return data;
}

RepeatedMeasuresAnova analyseRepeatedMeasures(const RepeatedMeasures& data, double level) {
  requireLevel(level);
  const size_t cells = check(data);
  RepeatedMeasuresAnova anova;
  anova.subjects = data.subjects;
  double largest = 0.0;
  for (const double value : data.values) {
    anova.grandMean += value / static_cast<double>(data.values.size());
    largest = std::max(largest, std::abs(value));
  }
  // What rounding may leave in the square of one contrast.
  const double noise =
      std::pow(16.0 * std::numeric_limits<double>::epsilon() * largest, 2.0) * static_cast<double>(cells);

  std::vector<Eigen::MatrixXd> contrasts;
  for (const WithinFactor& factor : data.factors) contrasts.push_back(orthonormalContrasts(factor.levels));
  std::vector<std::vector<double>> bySubject;
  for (size_t s = 0; s < data.subjects; ++s) {
    std::vector<double> own(data.values.begin() + static_cast<std::ptrdiff_t>(s * cells),
                            data.values.begin() + static_cast<std::ptrdiff_t>((s + 1) * cells));
    // The mean is taken off first: it would only cost the contrasts their last digits.
    for (double& value : own) value -= anova.grandMean;
    bySubject.push_back(transform(std::move(own), contrasts));
  }

  std::vector<std::vector<size_t>> cellsOfMask(size_t{1} << data.factors.size());
  for (size_t cell = 0; cell < cells; ++cell) cellsOfMask[maskOf(cell, data.factors)].push_back(cell);
  for (size_t s = 0; s < data.subjects; ++s) anova.subjectSumOfSquares += bySubject[s][0] * bySubject[s][0];

  for (size_t mask = 1; mask < cellsOfMask.size(); ++mask) {
    AnovaEffect effect;
    for (size_t f = 0; f < data.factors.size(); ++f) {
      if (!(mask >> f & 1)) continue;
      effect.factors.push_back(f);
      effect.name += (effect.name.empty() ? "" : " x ") + data.factors[f].name;
    }
    Eigen::MatrixXd z(static_cast<Eigen::Index>(data.subjects),
                      static_cast<Eigen::Index>(cellsOfMask[mask].size()));
    for (Eigen::Index s = 0; s < z.rows(); ++s)
      for (Eigen::Index c = 0; c < z.cols(); ++c)
        z(s, c) = bySubject[static_cast<size_t>(s)][cellsOfMask[mask][static_cast<size_t>(c)]];
    testEffect(effect, z, noise, level);
    anova.effects.push_back(std::move(effect));
  }
  std::stable_sort(anova.effects.begin(), anova.effects.end(),
                   [](const AnovaEffect& a, const AnovaEffect& b) {
                     return a.factors.size() != b.factors.size() ? a.factors.size() < b.factors.size()
                                                                 : a.factors < b.factors;
                   });

  double allErrors = anova.subjectSumOfSquares;
  for (const AnovaEffect& effect : anova.effects) allErrors += effect.errorSumOfSquares;
  for (AnovaEffect& effect : anova.effects)
    if (effect.sumOfSquares + allErrors > 0.0)
      effect.generalisedEtaSquared = effect.sumOfSquares / (effect.sumOfSquares + allErrors);
  return anova;
}

std::vector<std::vector<double>> levelMeans(const RepeatedMeasures& data, size_t factor) {
  const size_t cells = check(data);
  if (factor >= data.factors.size())
    throw Error(fmt::format("factor {} of {}", factor, data.factors.size()), "factor");
  const size_t levels = data.factors[factor].levels;
  size_t stride = 1;
  for (size_t f = factor + 1; f < data.factors.size(); ++f) stride *= data.factors[f].levels;

  // In extended precision, so that the order of cells does not break ties.
  std::vector<std::vector<long double>> sums(levels, std::vector<long double>(data.subjects, 0.0L));
  for (size_t i = 0; i < data.values.size(); ++i) sums[i / stride % levels][i / cells] += data.values[i];
  std::vector<std::vector<double>> means(levels);
  for (size_t level = 0; level < levels; ++level)
    for (const long double sum : sums[level])
      means[level].push_back(static_cast<double>(sum / static_cast<long double>(cells / levels)));
  return means;
}

std::vector<PairedComparison> comparePairs(const RepeatedMeasures& data, size_t factor, double level) {
  requireLevel(level);
  const std::vector<std::vector<double>> means = levelMeans(data, factor);
  const size_t levels = means.size();
  double largest = 0.0;
  for (const double value : data.values) largest = std::max(largest, std::abs(value));
  const double noise = 16.0 * std::numeric_limits<double>::epsilon() * largest;

  const auto n = static_cast<double>(data.subjects);
  std::vector<PairedComparison> comparisons;
  for (size_t first = 0; first < levels; ++first)
    for (size_t second = first + 1; second < levels; ++second) {
      PairedComparison c;
      c.first = first;
      c.second = second;
      c.df = n - 1.0;
      for (size_t s = 0; s < data.subjects; ++s) c.difference += (means[first][s] - means[second][s]) / n;
      double squares = 0.0;
      for (size_t s = 0; s < data.subjects; ++s)
        squares += std::pow(means[first][s] - means[second][s] - c.difference, 2.0);
      const double deviation = std::sqrt(squares / c.df);
      if (deviation > noise) {
        const double error = deviation / std::sqrt(n), reach = tCritical(1.0 - level, c.df) * error;
        c.standardisedDifference = c.difference / deviation;
        c.t = c.difference / error;
        c.p = tTwoSided(c.t, c.df);
        c.interval = around(c.difference, reach);
      } else {
        c.interval = {c.difference, c.difference};
        if (std::abs(c.difference) > noise) {
          c.t = std::copysign(kInfinity, c.difference);
          c.p = 0.0;
        }
      }
      comparisons.push_back(c);
    }
  adjustHolm(comparisons, &PairedComparison::p, &PairedComparison::pHolm);
  return comparisons;
}

}  // namespace limen::analysis
