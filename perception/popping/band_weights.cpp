// SPDX-License-Identifier: BSD-3-Clause
//
// The fit. A grating of frequency f and contrast 1 / S(f) has in level i the response sum_k w_ik B_ik(f) /
// S(f), B being the parts' transfers, and pooled the difference (sum_i |response|^p)^(1/p), which should be 1
// at all frequencies. First each level gets a share of the frequencies (raised cosines over lg f that add up
// to 1 when pooled) and the linear least-squares weights that come closest to it; from there Levenberg and
// Marquardt's method (Ceres's TinySolver) minimises the squares of ln D over kFrequencies frequencies, with a
// weak pull towards the start, which keeps neighbouring nodes alike. Each node starts from the one of the
// next lower velocity.
#include "perception/popping/band_weights.h"

#include <ceres/tiny_solver.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <string>

#include "experiments/base/text.h"
#include "perception/metrics/row_sums.h"
#include "perception/multiscale/band_peaks.h"

namespace limen::perception {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kFrequencies = 60;
constexpr double kLeastCpd = 0.2, kLargestCpd = 60.0;
constexpr double kVelocitiesPerOctave = 3.0, kLuminancesPerOctave = 0.5;
constexpr double kPull = 1e-5;    ///< of squared relative changes of weights, beside squares of ln D
constexpr double kCentre = 0.22;  ///< cycles per pixel of a level, at the middle of its share

/// Share of level `level` of `levels` in a frequency.
double shareOf(int level, int levels, double cyclesPerPx, double exponent) {
  const double octaves = std::log2(cyclesPerPx / kCentre) + level;
  if ((level == 0 && octaves > 0.0) || (level == levels - 1 && octaves < 0.0)) return 1.0;
  if (std::abs(octaves) >= 1.0) return 0.0;
  const double cosine = std::cos(0.5 * kPi * octaves);
  return std::pow(cosine * cosine, 1.0 / exponent);
}

/// Residuals: ln of the pooled difference at each frequency, then changes of the weights from the start.
struct Evenness {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };

  Eigen::MatrixXd responses;  // [frequency][level and part]: transfer over the larger of S and its least
  Eigen::VectorXd weights, targets;  // of frequencies; pooled difference to reach
  Eigen::VectorXd start, scale;      // of parameters; those fitted are multiples of scale
  double exponent = 2.4;

  int NumResiduals() const { return static_cast<int>(responses.rows() + start.size()); }
  int NumParameters() const { return static_cast<int>(start.size()); }
  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const Eigen::Map<const Eigen::VectorXd> x(parameters, NumParameters());
    Eigen::Map<Eigen::VectorXd> r(residuals, NumResiduals());
    const int levels = NumParameters() / kBandParts;
    if (jacobian) Eigen::Map<Eigen::MatrixXd>(jacobian, NumResiduals(), NumParameters()).setZero();
    const Eigen::VectorXd w = x.cwiseProduct(scale);
    for (int f = 0; f < responses.rows(); ++f) {
      double sum = 1e-12;
      std::vector<double> response(static_cast<size_t>(levels)), power(response);
      for (int i = 0; i < levels; ++i) {
        const auto at = static_cast<size_t>(i);
        response[at] =
            responses.row(f).segment<kBandParts>(i * kBandParts).dot(w.segment<kBandParts>(i * kBandParts));
        power[at] = response[at] == 0.0 ? 0.0 : std::pow(std::abs(response[at]), exponent);
        sum += power[at];
      }
      r[f] = weights[f] * (std::log(sum) / exponent - std::log(targets[f]));
      if (!jacobian) continue;
      Eigen::Map<Eigen::MatrixXd> j(jacobian, NumResiduals(), NumParameters());
      for (int i = 0; i < levels; ++i) {
        const auto at = static_cast<size_t>(i);
        if (response[at] == 0.0) continue;
        const double slope = weights[f] * power[at] / response[at] / sum;
        for (int k = i * kBandParts; k < (i + 1) * kBandParts; ++k)
          j(f, k) = slope * responses(f, k) * scale[k];
      }
    }
    const double pull = std::sqrt(kPull);
    for (int k = 0; k < NumParameters(); ++k) {
      const int row = static_cast<int>(responses.rows()) + k;
      r[row] = pull * (x[k] - start[k]);
      if (jacobian) Eigen::Map<Eigen::MatrixXd>(jacobian, NumResiduals(), NumParameters())(row, k) = pull;
    }
    return true;
  }
};

std::vector<double> fittedFrequencies(const BandWeights::Setup& setup) {
  const double high = std::min(0.5 * setup.pixelsPerDegree, kLargestCpd);
  const double low = std::min(std::max(kLeastCpd, 0.55 * setup.peakCpd.back()), 0.5 * high);
  std::vector<double> out;
  for (int f = 0; f < kFrequencies; ++f)
    out.push_back(low * std::pow(high / low, static_cast<double>(f) / (kFrequencies - 1)));
  return out;
}

/// Linear weights of each level that come closest to its share.
Eigen::VectorXd linearStart(const Eigen::MatrixXd& responses, const Eigen::VectorXd& targets,
                            const std::vector<double>& frequencies, const BandWeights::Setup& setup) {
  const int levels = static_cast<int>(setup.peakCpd.size());
  Eigen::VectorXd out(levels * kBandParts);
  for (int i = 0; i < levels; ++i) {
    const auto columns = responses.middleCols<kBandParts>(i * kBandParts);
    Eigen::VectorXd share(responses.rows());
    for (int f = 0; f < responses.rows(); ++f)
      share[f] = targets[f] * shareOf(i, levels, frequencies[static_cast<size_t>(f)] / setup.pixelsPerDegree,
                                      setup.minkowskiExponent);
    Eigen::Matrix3d normal = columns.transpose() * columns;
    normal += Eigen::Matrix3d::Identity() * (1e-4 * normal.trace() / kBandParts + 1e-12);
    out.segment<kBandParts>(i * kBandParts) = normal.ldlt().solve(columns.transpose() * share);
  }
  return out;
}

}  // namespace

std::vector<std::array<double, kBandParts>> bandPartTransfers(const BandSettings& bands, int levels,
                                                              double cyclesPerPx) {
  std::vector<std::array<double, kBandParts>> out;
  const double w = 2.0 * kPi * cyclesPerPx;
  const Kernel kernel = bands.kernel();
  for (int i = 0; i < levels; ++i) {
    const double own = std::ldexp(w, i), reached = gaussianLevelTransfer(kernel, i, w);
    const double cosine = std::cos(0.5 * own), once = cosine * cosine;
    // Level 0's band is 1 - what comes back from the next level.
    const double next = 1.0 - bandTransfer(kernel, bands.upsampler(), PeakModel::WithUpsample, 0, own);
    out.push_back({reached * (1.0 - once), reached * (once - once * once), reached * (once * once - next)});
  }
  return out;
}

BandWeights::Axis::Axis(Range range, double perOctave) : lnLow(std::log(range.low)) {
  const double octaves = std::log2(range.high / range.low);
  nodes = std::max(2, static_cast<int>(std::ceil(octaves * perOctave)) + 1);
  perLn = (nodes - 1) / std::max(1e-9, std::log(range.high / range.low));
}

double BandWeights::Axis::value(int node) const { return std::exp(lnLow + node / perLn); }

std::pair<int, double> BandWeights::Axis::place(double value) const {
  const double at = value > 0.0 ? std::clamp((std::log(value) - lnLow) * perLn, 0.0, nodes - 1.0) : 0.0;
  const int node = std::min(static_cast<int>(at), nodes - 2);
  return {node, at - node};
}

BandWeights::BandWeights(const Setup& setup, const Sensitivity& sensitivity)
    : velocity_(setup.velocityDegS, kVelocitiesPerOctave),
      luminance_(setup.luminanceCdM2, kLuminancesPerOctave) {
  const auto levels = setup.peakCpd.size();
  nodes_.resize(static_cast<size_t>(velocity_.nodes) * luminance_.nodes, Node(levels));
  if (levels == 0) return;
  const std::vector<double> frequencies = fittedFrequencies(setup);
  Eigen::MatrixXd transfers(kFrequencies, static_cast<Eigen::Index>(levels) * kBandParts);
  for (int f = 0; f < kFrequencies; ++f) {
    const auto parts = bandPartTransfers(setup.bands, static_cast<int>(levels),
                                         frequencies[static_cast<size_t>(f)] / setup.pixelsPerDegree);
    for (size_t i = 0; i < levels; ++i)
      for (size_t k = 0; k < kBandParts; ++k)
        transfers(f, static_cast<Eigen::Index>(i * kBandParts + k)) = parts[i][k];
  }
  forEachRow(luminance_.nodes, size_t{1} << 20, [&](int l) {
    const double luminance = luminance_.value(l);
    Eigen::VectorXd previous;
    for (int v = 0; v < velocity_.nodes; ++v) {
      const double velocity = velocity_.value(v);
      Evenness fit;
      fit.exponent = setup.minkowskiExponent;
      fit.responses = transfers;
      fit.weights.setOnes(kFrequencies);
      fit.targets.setOnes(kFrequencies);
      for (int f = 0; f < kFrequencies; ++f) {
        const double s = std::max(0.0, sensitivity(frequencies[static_cast<size_t>(f)], velocity, luminance));
        const double least = std::max(s, kLeastSensitivity);
        fit.responses.row(f) /= least;
        fit.targets[f] = std::max(s / least, 1e-6);
        fit.weights[f] = std::min(1.0, s);
      }
      const Eigen::VectorXd linear = linearStart(fit.responses, fit.targets, frequencies, setup);
      fit.scale = linear.cwiseAbs().cwiseMax(1e-6);
      fit.start = linear.cwiseQuotient(fit.scale);
      Eigen::VectorXd x = previous.size() ? Eigen::VectorXd(previous.cwiseQuotient(fit.scale)) : fit.start;
      ceres::TinySolver<Evenness> solver;
      solver.options.max_num_iterations = v == 0 ? 60 : 12;
      solver.options.gradient_tolerance = 1e-9;
      solver.options.parameter_tolerance = 1e-7;
      solver.Solve(fit, &x);
      previous = x.cwiseProduct(fit.scale);
      Node& node = nodes_[static_cast<size_t>(l) * velocity_.nodes + v];
      for (size_t i = 0; i < levels; ++i) {
        const double peak = std::max(sensitivity(setup.peakCpd[i], velocity, luminance), kLeastSensitivity);
        for (size_t k = 0; k < kBandParts; ++k)
          node[i][k] = previous[static_cast<Eigen::Index>(i * kBandParts + k)] / peak;
      }
    }
  });
}

std::array<double, kBandParts> BandWeights::at(int level, double velocityDegS, double luminanceCdM2) const {
  const auto [v, toFaster] = velocity_.place(velocityDegS);
  const auto [l, toBrighter] = luminance_.place(luminanceCdM2);
  std::array<double, kBandParts> out{};
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const double share = (i ? toFaster : 1.0 - toFaster) * (j ? toBrighter : 1.0 - toBrighter);
      const auto& node =
          nodes_[static_cast<size_t>(l + j) * velocity_.nodes + v + i][static_cast<size_t>(level)];
      for (size_t k = 0; k < kBandParts; ++k) out[k] += share * node[k];
    }
  return out;
}

std::shared_ptr<const BandWeights> bandWeights(const BandWeights::Setup& setup, const std::string& key,
                                               const BandWeights::Sensitivity& sensitivity) {
  constexpr size_t kKept = 24;
  std::string all = key + (setup.bands.upsampler() == Upsampler::Expand ? "|expand" : "|linear");
  for (const double value :
       {setup.bands.kernelCentre, setup.minkowskiExponent, setup.pixelsPerDegree, setup.velocityDegS.low,
        setup.velocityDegS.high, setup.luminanceCdM2.low, setup.luminanceCdM2.high})
    all += "|" + shortestNumber(value);
  for (const double value : setup.peakCpd) all += "|" + shortestNumber(value);
  static std::mutex guard;
  static std::vector<std::pair<std::string, std::shared_ptr<const BandWeights>>> kept;
  {
    const std::scoped_lock lock(guard);
    for (const auto& [known, weights] : kept)
      if (known == all) return weights;
  }
  auto made = std::make_shared<const BandWeights>(setup, sensitivity);
  const std::scoped_lock lock(guard);
  if (kept.size() == kKept) kept.erase(kept.begin());
  kept.emplace_back(all, made);
  return made;
}

}  // namespace limen::perception
