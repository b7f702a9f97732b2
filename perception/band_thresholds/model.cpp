// SPDX-License-Identifier: BSD-3-Clause
#include "perception/band_thresholds/model.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "perception/multiscale/pyramid.h"
#include "perception/vision/csf.h"
#include "perception/vision/eye_movement.h"
#include "perception/vision/masking.h"

namespace limen::perception {
namespace {

constexpr double kLeastContrast = 1e-4, kLargestContrast = 1e7;
constexpr int kContrastCells = 4096;
/// From this band on the filters' spreads differ by less than 1e-3.
constexpr int kLastOwnSpread = 4;

/// x >= 0 where an increasing function reaches `value`; kLargestContrast squared if it does not.
double inverse(const std::function<double(double)>& function, double value) {
  double high = 1.0;
  while (function(high) < value) {
    high *= 4.0;
    if (high > kLargestContrast * kLargestContrast) return high;
  }
  double low = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (function(middle) < value ? low : high) = middle;
  }
  return low;
}

/// Distance to the nearer contrast whose response differs by `jnd`. The transducer is odd and increases.
double stepOf(const std::function<double(double)>& transducer, double jnd, double x) {
  const double response = transducer(x);
  const double less =
      response >= jnd ? inverse(transducer, response - jnd) : -inverse(transducer, jnd - response);
  const double more = inverse(transducer, response + jnd);
  return std::max(std::min(x - less, more - x), 0.0);
}

/// Weights of level `level`'s sample `at` over the pixels of one axis, or (`up`) of the next level brought to
/// this one.
using Weights = std::map<int, double>;
void pass(Weights& weights, const AxisTaps& taps) {
  Weights finer;
  for (const auto& [sample, weight] : weights)
    for (int tap = 0; tap < taps.taps; ++tap) {
      const auto i = static_cast<size_t>(sample * taps.taps + tap);
      finer[taps.index[i]] += weight * taps.weight[i];
    }
  weights = std::move(finer);
}

Weights weightsOf(const PyramidSettings& pyramid, int size, int level, int at, bool up) {
  Weights weights{{at, 1.0}};
  if (up) {
    const int fine = size >> level;
    pass(weights, pyramid.upsampler == Upsampler::Expand
                      ? expansionTaps(fine / 2, fine, pyramid.kernel, pyramid.border)
                      : bilinearTaps(fine / 2, fine, true, 1, pyramid.border));
    pass(weights, reductionTaps(fine, pyramid.kernel, pyramid.border));
  }
  for (int i = level; i > 0; --i)
    pass(weights, reductionTaps(size >> (i - 1), pyramid.kernel, pyramid.border));
  return weights;
}

/// Sum of magnitudes of the filter that makes band `level`; the larger of its even and odd samples'.
double spreadOf(const PyramidSettings& pyramid, int level) {
  const int size = 64 << level;
  double largest = 0.0;
  for (int odd = 0; odd < 4; ++odd) {
    const int x = 32 + odd % 2, y = 32 + odd / 2;
    const Weights ownX = weightsOf(pyramid, size, level, x, false),
                  ownY = weightsOf(pyramid, size, level, y, false),
                  upX = weightsOf(pyramid, size, level, x, true),
                  upY = weightsOf(pyramid, size, level, y, true);
    const auto at = [](const Weights& weights, int i) {
      const auto found = weights.find(i);
      return found == weights.end() ? 0.0 : found->second;
    };
    double sum = 0.0;
    for (const auto& [row, rowWeight] : upY) {
      const double ownRow = at(ownY, row);
      for (const auto& [column, weight] : upX)
        sum += std::abs(ownRow * at(ownX, column) - rowWeight * weight);
    }
    largest = std::max(largest, sum);
  }
  return largest;
}

}  // namespace

BandThresholdModel::BandThresholdModel(const BandThresholdSettings& settings, const DisplayProfile& display,
                                       int widthPx, int heightPx)
    : settings_((settings.check(), settings)),
      model_(poppingModel(widthPx, heightPx, display, settings.predictor)),
      sensitivity_(model_, display, settings.predictor, true),
      velocityDegS_(
          retinalVelocityDegS(0.0, settings.predictor.eyeModel(), settings.predictor.leastVelocityDegS())) {
  CsfPoint point = viewingPoint(model_.areaDeg2, model_.widthDeg, display);
  point.velocityDegS = velocityDegS_;
  peakSensitivity_ =
      makeCsf(settings.predictor.sensitivity.achromatic.csf.name, "predictor")->peak(point).sensitivity *
      model_.scaleA * settings.predictor.sensitivity.greyGain();
  const Masking masking = makeMasking(settings.predictor.masking, "predictor.masking");
  step_ = FineTable([transducer = masking.transducer,
                     jnd = settings.jnd](double x) { return stepOf(transducer, jnd, std::max(x, 0.0)); },
                    kLeastContrast, kLargestContrast, kContrastCells);
  const PyramidSettings pyramid{12, settings.predictor.bands.kernel(), settings.predictor.bands.upsampler(),
                                Border::Clamp};
  for (int band = 0; band < bands(); ++band)
    spreads_.push_back(band > kLastOwnSpread
                           ? spreads_[kLastOwnSpread] * model_.gain[kLastOwnSpread] / model_.gain[band]
                           : spreadOf(pyramid, band) / model_.gain[band]);
}

double BandThresholdModel::sensitivity(int band, double luminanceCdM2) const {
  // Darker, sensitivity only falls: thresholds are those at the end, and safe.
  constexpr double kLeastCdM2 = 1e-4, kLargestCdM2 = 1e6;
  const double held = luminanceCdM2 > kLeastCdM2 ? std::min(luminanceCdM2, kLargestCdM2) : kLeastCdM2;
  return settings_.predictor.sensitivity.greyGain() * sensitivity_.at(band, velocityDegS_, held)[0];
}

double BandThresholdModel::contrastStep(int band, double contrast, double luminanceCdM2) const {
  // A band that nobody sees at this luminance has a threshold all the same.
  constexpr double kLeastSensitivity = 1e-6;
  const double s = std::max(sensitivity(band, luminanceCdM2), kLeastSensitivity);
  return step(contrast * s) / s;
}

double BandThresholdModel::uniformCdM2(double luminanceCdM2) const {
  return settings_.jnd * luminanceCdM2 / peakSensitivity_;
}

}  // namespace limen::perception
