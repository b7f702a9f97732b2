// SPDX-License-Identifier: BSD-3-Clause
#include "perception/multiscale/band_peaks.h"

#include <algorithm>
#include <array>
#include <complex>
#include <map>
#include <mutex>
#include <numbers>
#include <tuple>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::perception {
namespace {

constexpr double kPi = std::numbers::pi;

/// Largest value of `transfer` over (0, 0.5] cycles per pixel: a scan fine enough for the narrowest band,
/// then golden section.
BandPeak findPeak(const std::function<double(double)>& transfer) {
  constexpr int kSteps = 1500;
  constexpr double kLow = 1e-4;
  const auto at = [&](double lg) { return transfer(2.0 * kPi * std::pow(10.0, lg)); };
  const double lgLow = std::log10(kLow), lgHigh = std::log10(0.5), step = (lgHigh - lgLow) / kSteps;
  int best = kSteps;  // from above: a plateau at Nyquist counts as Nyquist
  for (int i = kSteps; i-- > 0;)
    if (at(lgLow + i * step) > at(lgLow + best * step)) best = i;
  if (best == kSteps) return {0.5, at(lgHigh)};
  double low = lgLow + std::max(best - 1, 0) * step, high = lgLow + (best + 1) * step;
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  for (int i = 0; i < 80; ++i) {
    const double a = high - ratio * (high - low), b = low + ratio * (high - low);
    (at(a) > at(b) ? high : low) = at(a) > at(b) ? b : a;
  }
  const double lg = 0.5 * (low + high);
  return {std::pow(10.0, lg), at(lg)};
}

/// Transfer of one step of the upsampler at w radians per pixel of its result.
double upsamplerTransfer(const Kernel& kernel, Upsampler upsampler, double w) {
  if (upsampler == Upsampler::Expand) return kernel.transfer(w);
  // Linear interpolation on the cosited grid is 1 2 1, on the centred one 1 3 3 1.
  const double half = std::abs(std::cos(0.5 * w));
  return std::pow(half, kernel.fused ? 3.0 : 2.0);
}

/// Amplitude of the component at w rad/px of samples at `positions`, seen through a Hann window.
std::complex<double> amplitude(const double* samples, const std::vector<double>& positions, double lengthPx,
                               double w) {
  std::complex<double> sum = 0.0;
  double weights = 0.0;
  for (size_t i = 0; i < positions.size(); ++i) {
    const double window = 0.5 - 0.5 * std::cos(2.0 * kPi * (positions[i] + 0.5) / lengthPx);
    sum += window * samples[i] * std::polar(1.0, -w * positions[i]);
    weights += window;
  }
  return sum / weights;
}

/// Positions of a level's samples, in pixels of the finest level.
std::vector<double> samplePositions(int finest, int size, const Kernel& kernel) {
  std::vector<double> out;
  const double scale = static_cast<double>(finest) / size;
  for (int x = 0; x < size; ++x)
    out.push_back(kernel.fused || size == finest ? (x + 0.5) * scale - 0.5 : x * scale);
  return out;
}

/// Complex amplitude of band `level` at w rad/px.
std::complex<double> bandAmplitude(const std::vector<Plane>& levels, int level, const GratingSweep& sweep,
                                   double w) {
  const int finest = levels[0].width;
  const auto amplitudeOf = [&](const Plane& plane, double mean) {
    std::vector<double> samples(plane.row(plane.height / 2), plane.row(plane.height / 2) + plane.width);
    for (double& value : samples) value -= mean;
    return amplitude(samples.data(), samplePositions(finest, plane.width, sweep.settings.kernel), finest, w);
  };
  const Plane& own = levels[static_cast<size_t>(level)];
  const Plane& next = levels[static_cast<size_t>(level) + 1];
  if (!sweep.upsampled) return amplitudeOf(own, 1.0) - amplitudeOf(next, 1.0);
  Plane band = next.width == own.width ? next : upsampleLevel(levels, level + 1, level, sweep.settings);
  for (size_t p = 0; p < band.data.size(); ++p) band.data[p] = own.data[p] - band.data[p];
  return amplitudeOf(band, 0.0);
}

/// Largest response, between the measured frequencies by a parabola over lg f.
BandPeak vertex(const std::vector<BandPeak>& response) {
  if (response.empty()) return {};
  const auto best = std::max_element(response.begin(), response.end(),
                                     [](const BandPeak& a, const BandPeak& b) { return a.gain < b.gain; });
  if (best == response.begin() || best + 1 == response.end()) return *best;
  const double x0 = std::log10((best - 1)->frequencyCyclesPerPx), x1 = std::log10(best->frequencyCyclesPerPx),
               x2 = std::log10((best + 1)->frequencyCyclesPerPx);
  const double y0 = (best - 1)->gain, y1 = best->gain, y2 = (best + 1)->gain;
  const double slope = (y1 - y0) / (x1 - x0);
  const double bend = ((y2 - y1) / (x2 - x1) - slope) / (x2 - x0);
  if (!(bend < 0.0)) return *best;
  const double x = 0.5 * (x0 + x1) - 0.5 * slope / bend;
  return {std::pow(10.0, x), y0 + slope * (x - x0) + bend * (x - x0) * (x - x1)};
}

}  // namespace

double gaussianLevelTransfer(const Kernel& kernel, int level, double w) {
  double product = 1.0;
  for (int i = 0; i < level; ++i) product *= std::abs(kernel.transfer(std::ldexp(w, i)));
  return product;
}

double bandTransfer(const Kernel& kernel, Upsampler upsampler, PeakModel model, int level, double w) {
  const double own = std::ldexp(w, level);
  double coarser = std::abs(kernel.transfer(own));
  if (model == PeakModel::WithUpsample) coarser *= std::abs(upsamplerTransfer(kernel, upsampler, own));
  return gaussianLevelTransfer(kernel, level, w) * (1.0 - coarser);
}

std::vector<BandPeak> bandPeaks(const Kernel& kernel, Upsampler upsampler, PeakModel model, int count) {
  // Searched for once: a model is made for each comparison, and this takes longer than a small picture.
  constexpr size_t kKept = 64;
  using Key = std::tuple<std::array<double, 5>, bool, bool, Upsampler, PeakModel, int>;
  static std::mutex guard;
  static std::map<Key, std::vector<BandPeak>> kept;
  const Key key{kernel.taps, kernel.fused, kernel.nineFetch, upsampler, model, count};
  const std::scoped_lock lock(guard);
  if (const auto found = kept.find(key); found != kept.end()) return found->second;
  std::vector<BandPeak> out;
  for (int level = 0; level < count; ++level) {
    if (model == PeakModel::Halving)
      out.push_back({std::ldexp(0.5, -level), 1.0});
    else
      out.push_back(findPeak([&](double w) { return bandTransfer(kernel, upsampler, model, level, w); }));
  }
  if (kept.size() >= kKept) kept.clear();
  kept[key] = out;
  return out;
}

std::vector<BandPeak> stackBandPeaks(const Kernel& kernel, int count, double sigmaPx) {
  std::vector<BandPeak> out;
  for (int level = 0; level < count; ++level) {
    const double fine = stackSigmaPx(level, kernel, sigmaPx);
    const double coarse = stackSigmaPx(level + 1, kernel, sigmaPx);
    out.push_back(findPeak([&](double w) {
      return std::exp(-0.5 * w * w * fine * fine) - std::exp(-0.5 * w * w * coarse * coarse);
    }));
  }
  return out;
}

std::vector<BandPeak> measureBandPeaks(const std::function<std::vector<Plane>(const Plane&)>& decompose,
                                       int count, const GratingSweep& sweep) {
  const int width = sweep.widthPx;
  std::vector<std::vector<BandPeak>> responses(static_cast<size_t>(count));
  int previous = 0;
  for (double f = sweep.lowestCyclesPerPx; previous < width / 2; f *= sweep.step) {
    // Whole cycles in the width, Nyquist last.
    const int cycles = std::min(static_cast<int>(std::lround(f * width)), width / 2);
    if (cycles == previous) continue;
    previous = cycles;
    const double w = 2.0 * kPi * cycles / width;
    // e^iwx in two parts: a cosine alone would be mistaken for its conjugate where a coarse level's samples
    // cannot distinguish the two.
    Plane cosine(width, sweep.heightPx), sine = cosine;
    for (int y = 0; y < cosine.height; ++y)
      for (int x = 0; x < width; ++x) {
        cosine.at(x, y) = 1.0 + 0.5 * std::cos(w * x);
        sine.at(x, y) = 1.0 + 0.5 * std::sin(w * x);
      }
    const std::vector<Plane> levels = decompose(cosine), quadrature = decompose(sine);
    for (size_t i = 0; i < static_cast<size_t>(count) && i + 1 < levels.size(); ++i) {
      const int level = static_cast<int>(i);
      const std::complex<double> both =
          bandAmplitude(levels, level, sweep, w) +
          std::complex<double>(0.0, 1.0) * bandAmplitude(quadrature, level, sweep, w);
      responses[i].push_back({static_cast<double>(cycles) / width, 2.0 * std::abs(both)});
    }
  }
  std::vector<BandPeak> out;
  for (const std::vector<BandPeak>& response : responses) out.push_back(vertex(response));
  return out;
}

double largestPeakMismatch(const std::vector<BandPeak>& measured, const std::vector<BandPeak>& assumed) {
  double largest = 0.0;
  for (size_t i = 0; i < std::min(measured.size(), assumed.size()); ++i)
    largest =
        std::max(largest, std::abs(measured[i].frequencyCyclesPerPx / assumed[i].frequencyCyclesPerPx - 1.0));
  return largest;
}

void requirePeaks(const std::vector<BandPeak>& measured, const std::vector<BandPeak>& assumed,
                  const std::string& where) {
  for (size_t i = 0; i < std::min(measured.size(), assumed.size()); ++i) {
    const double ratio = measured[i].frequencyCyclesPerPx / assumed[i].frequencyCyclesPerPx;
    if (std::abs(ratio - 1.0) > kLargestAllowedPeakMismatch)
      throw Error("band " + std::to_string(i) + " peaks at " +
                      shortestNumber(measured[i].frequencyCyclesPerPx) + " cycles per pixel, where " +
                      shortestNumber(assumed[i].frequencyCyclesPerPx) + " is assumed",
                  where, "read the CSF where the bands peak");
  }
}

}  // namespace limen::perception
