// SPDX-License-Identifier: BSD-3-Clause
//
// The fit. A grating of frequency f and contrast 1 / S(f) has in level i the response sum_k w_ik B_ik(f) /
// S(f), B being the parts' transfers, some of that of its image in the last part too, and
// pooled the difference (sum_i |response|^p)^(1/p), which should be 1 at all frequencies. First each level
// gets a share of the frequencies (raised cosines over lg f that add up to 1 when pooled) and the linear
// least-squares weights that come closest to it; from there Levenberg and Marquardt's method (Ceres's
// TinySolver) minimises the squares of ln D over kFrequencies frequencies, with a weak pull towards the
// start. Responses of opposite signs in two levels would pool as well, but fits with and without such a
// change of sign cannot be interpolated: negative responses cost too. Each node is fitted by itself; where
// neighbours start from each other's results, a bad minimum lasts over octaves of velocity.
//
// Where sensitivity falls with more than 20 dB an octave, above 2 deg/s, the bands cannot follow it to its
// end. Frequencies that need contrasts above 1 / kCertain count less there, by the fourth power of their
// sensitivity: fits that follow them are several dB off where contrasts are common.
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
constexpr double kVelocitiesPerOctave = 6.0, kLuminancesPerOctave = 1.0;
constexpr double kPull = 1e-5;  ///< of squared relative changes of weights, beside squares of ln D
constexpr double kImage = 0.2;  ///< of an image's amplitude, which rarely adds to the grating's at its peak
constexpr double kNegative = 0.3;  ///< of negative responses, relative to the pooled one
constexpr double kCertain = 5.0;   ///< sensitivity from which frequencies count fully
constexpr int kIterations = 40;
constexpr double kCentre = 0.22;  ///< cycles per pixel of a level, at the middle of its share

/// Share of level `level` of `levels` in a frequency.
double shareOf(int level, int levels, double cyclesPerPx, double exponent) {
  const double octaves = std::log2(cyclesPerPx / kCentre) + level;
  if ((level == 0 && octaves > 0.0) || (level == levels - 1 && octaves < 0.0)) return 1.0;
  if (std::abs(octaves) >= 1.0) return 0.0;
  const double cosine = std::cos(0.5 * kPi * octaves);
  return std::pow(cosine * cosine, 1.0 / exponent);
}

/// Residuals: ln of the pooled difference at each frequency, then the negative responses there, then changes
/// of the weights from the start.
struct Evenness {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };

  Eigen::MatrixXd responses;  // [frequency][level and part]: transfer over the larger of S and its least
  Eigen::MatrixXd images;     // [frequency][level]: likewise, of the last part
  Eigen::VectorXd weights, targets;  // of frequencies; pooled difference to reach
  Eigen::VectorXd start, scale;      // of parameters; those fitted are multiples of scale
  double exponent = 2.4;

  int NumResiduals() const { return static_cast<int>(2 * responses.rows() + start.size()); }
  int NumParameters() const { return static_cast<int>(start.size()); }
  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const Eigen::Map<const Eigen::VectorXd> x(parameters, NumParameters());
    Eigen::Map<Eigen::VectorXd> r(residuals, NumResiduals());
    const int levels = NumParameters() / kBandParts;
    if (jacobian) Eigen::Map<Eigen::MatrixXd>(jacobian, NumResiduals(), NumParameters()).setZero();
    const Eigen::VectorXd w = x.cwiseProduct(scale);
    for (int f = 0; f < responses.rows(); ++f) {
      double sum = 1e-12, negative = 1e-12;
      std::vector<double> response(static_cast<size_t>(levels)), magnitude(response), power(response);
      for (int i = 0; i < levels; ++i) {
        const auto at = static_cast<size_t>(i);
        response[at] =
            responses.row(f).segment<kBandParts>(i * kBandParts).dot(w.segment<kBandParts>(i * kBandParts));
        magnitude[at] =
            std::abs(response[at]) + kImage * images(f, i) * std::abs(w[i * kBandParts + kBandParts - 1]);
        power[at] = magnitude[at] == 0.0 ? 0.0 : std::pow(magnitude[at], exponent);
        sum += power[at];
        if (response[at] < 0.0) negative += response[at] * response[at];
      }
      const auto below = responses.rows() + f;
      const double norm = std::sqrt(negative), factor = kNegative * weights[f] / targets[f];
      r[below] = factor * norm;
      r[f] = weights[f] * (std::log(sum) / exponent - std::log(targets[f]));
      if (!jacobian) continue;
      Eigen::Map<Eigen::MatrixXd> j(jacobian, NumResiduals(), NumParameters());
      for (int i = 0; i < levels; ++i) {
        const auto at = static_cast<size_t>(i);
        if (magnitude[at] == 0.0) continue;
        const double slope = weights[f] * power[at] / magnitude[at] / sum;
        const double sign = response[at] < 0.0 ? -1.0 : 1.0;
        for (int k = i * kBandParts; k < (i + 1) * kBandParts; ++k) {
          j(f, k) = slope * sign * responses(f, k) * scale[k];
          if (response[at] < 0.0) j(below, k) = factor * response[at] / norm * responses(f, k) * scale[k];
        }
        const int last = i * kBandParts + kBandParts - 1;
        j(f, last) += slope * (w[last] < 0.0 ? -1.0 : 1.0) * kImage * images(f, i) * scale[last];
      }
    }
    const double pull = std::sqrt(kPull);
    for (int k = 0; k < NumParameters(); ++k) {
      const int row = static_cast<int>(2 * responses.rows()) + k;
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

std::vector<double> bandImageTransfers(const BandSettings& bands, int levels, double cyclesPerPx) {
  const double w = 2.0 * kPi * cyclesPerPx;
  const Kernel kernel = bands.kernel();
  std::vector<double> out;
  for (int i = 0; i < levels; ++i) {
    const double own = std::ldexp(w, i), sine = std::sin(0.5 * own);
    const double upsampled =
        bands.upsampler() == Upsampler::Expand ? gaussianLevelTransfer(kernel, 1, own + kPi) : sine * sine;
    out.push_back(std::abs(gaussianLevelTransfer(kernel, i + 1, w) * upsampled));
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
  Eigen::MatrixXd images(kFrequencies, static_cast<Eigen::Index>(levels));
  for (int f = 0; f < kFrequencies; ++f) {
    const double cyclesPerPx = frequencies[static_cast<size_t>(f)] / setup.pixelsPerDegree;
    const auto parts = bandPartTransfers(setup.bands, static_cast<int>(levels), cyclesPerPx);
    const auto image = bandImageTransfers(setup.bands, static_cast<int>(levels), cyclesPerPx);
    for (size_t i = 0; i < levels; ++i) images(f, static_cast<Eigen::Index>(i)) = image[i];
    for (size_t i = 0; i < levels; ++i)
      for (size_t k = 0; k < kBandParts; ++k)
        transfers(f, static_cast<Eigen::Index>(i * kBandParts + k)) = parts[i][k];
  }
  forEachRow(luminance_.nodes, size_t{1} << 20, [&](int l) {
    const double luminance = luminance_.value(l);
    for (int v = 0; v < velocity_.nodes; ++v) {
      const double velocity = velocity_.value(v);
      Evenness fit;
      fit.exponent = setup.minkowskiExponent;
      fit.responses = transfers;
      fit.images = images;
      fit.weights.setOnes(kFrequencies);
      fit.targets.setOnes(kFrequencies);
      for (int f = 0; f < kFrequencies; ++f) {
        const double s = std::max(0.0, sensitivity(frequencies[static_cast<size_t>(f)], velocity, luminance));
        const double least = std::max(s, kLeastSensitivity);
        fit.responses.row(f) /= least;
        fit.images.row(f) /= least;
        fit.targets[f] = std::max(s / least, 1e-6);
        fit.weights[f] = std::pow(std::min(1.0, s / kCertain), 4.0);
      }
      const Eigen::VectorXd linear = linearStart(fit.responses, fit.targets, frequencies, setup);
      fit.scale = linear.cwiseAbs().cwiseMax(1e-6);
      fit.start = linear.cwiseQuotient(fit.scale);
      Eigen::VectorXd x = fit.start;
      ceres::TinySolver<Evenness> solver;
      solver.options.max_num_iterations = kIterations;
      solver.options.gradient_tolerance = 1e-9;
      solver.options.parameter_tolerance = 1e-7;
      solver.Solve(fit, &x);
      const Eigen::VectorXd found = x.cwiseProduct(fit.scale);
      Node& node = nodes_[static_cast<size_t>(l) * velocity_.nodes + v];
      for (size_t i = 0; i < levels; ++i) {
        const double peak = std::max(sensitivity(setup.peakCpd[i], velocity, luminance), kLeastSensitivity);
        for (size_t k = 0; k < kBandParts; ++k)
          node[i][k] = found[static_cast<Eigen::Index>(i * kBandParts + k)] / peak;
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
