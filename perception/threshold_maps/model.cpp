// SPDX-License-Identifier: BSD-3-Clause
#include "perception/threshold_maps/model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "perception/vision/tvi.h"

namespace limen::perception {
namespace {

// Nodes of the peak sensitivity over lg luminance.
constexpr double kLgLow = -4.0, kLgHigh = 6.0;
constexpr int kNodesPerDecade = 100;
constexpr int kNodes = static_cast<int>((kLgHigh - kLgLow) * kNodesPerDecade) + 1;
// Fits end here, and so do the GPU's tables.
constexpr double kLeastCdM2 = 1e-4, kLargestCdM2 = 1e6;
constexpr double kLargestElevation = 1e12;  ///< as clamped by frequencyFactor()

using Settings = ThresholdMapSettings;

double held(double luminanceCdM2) {
  return luminanceCdM2 > 0.0 ? std::clamp(luminanceCdM2, kLeastCdM2, kLargestCdM2) : kLeastCdM2;
}

}  // namespace

double levelWidthPx(const Settings& settings, int level) {
  if (level == 0) return 1.0;
  const Kernel kernel = settings.kernel();
  const double powers = std::ldexp(1.0, 2 * level);
  double variance = kernel.variancePx2() * (powers - 1.0) / 3.0;
  if (settings.isTrueStack()) {
    const double sigma = stackSigmaPx(level, kernel, settings.stackSigmaPx());
    variance = sigma * sigma;
  } else if (std::holds_alternative<RepeatedStack>(settings.decomposition)) {
    variance = Kernel::binomial5().variancePx2() * level;
  } else if (settings.isPyramid()) {
    // A tent of half-width 2^level, minus the effect of sampling it on pixels.
    variance += powers / 6.0;
  } else {
    // 1 3 3 1 of 8 (variance 3/4) at every step, or the kernel again.
    variance += (settings.expands() ? kernel.variancePx2() : 0.75) * (powers - 1.0) / 3.0;
  }
  return std::sqrt(2.0 * std::numbers::pi * variance);
}

AdaptationBlend adaptationBlend(const Settings& settings, double pixelsPerDegree, int levels) {
  const int last = levels - 1;
  const auto nearest = [&](double level) {
    return AdaptationBlend{static_cast<int>(std::clamp(level, 0.0, static_cast<double>(last))), 0.0};
  };
  const double lgPpd = std::log2(std::max(pixelsPerDegree, 1e-6));
  if (std::holds_alternative<NearestLevelAdaptation>(settings.adaptation)) return nearest(std::round(lgPpd));
  if (const auto* given = std::get_if<GivenLevelAdaptation>(&settings.adaptation))
    return nearest(given->level);
  if (std::holds_alternative<FractionalLevelAdaptation>(settings.adaptation)) {
    AdaptationBlend blend = nearest(std::floor(lgPpd));
    if (lgPpd > 0.0 && blend.level < last) blend.next = lgPpd - std::floor(lgPpd);
    return blend;
  }
  AdaptationBlend blend;
  while (blend.level < last && levelWidthPx(settings, blend.level + 1) <= pixelsPerDegree) ++blend.level;
  if (blend.level == last) return blend;
  // Slopes of step edges add: 1 / ppd = (1 - t) / narrow + t / wide.
  const double narrow = 1.0 / levelWidthPx(settings, blend.level);
  const double wide = 1.0 / levelWidthPx(settings, blend.level + 1);
  blend.next = std::clamp((narrow - 1.0 / pixelsPerDegree) / (narrow - wide), 0.0, 1.0);
  return blend;
}

template <class Low>
double ThresholdModel::lowFrequencyOr(const Low& low, int band, double elevation) const {
  const auto* none = std::get_if<NoLowElevation>(&low);
  return none && at(band, 1.0).frequencyCpd < none->belowCpd ? 1.0 : elevation;
}

ThresholdModel::ThresholdModel(const Settings& settings, double pixelsPerDegree, int widthPx, int heightPx)
    : settings_(settings),
      pixelsPerDegree_(pixelsPerDegree),
      levels_(std::min(settings.levels, mostLevels(widthPx, heightPx))),
      csf_(makeCsf(settings.csf, "csf")),
      masking_(makeMasking(settings.masking, "masking")) {
  if (!(pixelsPerDegree > 0.0) || !std::isfinite(pixelsPerDegree))
    throw Error("pixels per degree must be a positive number", "display");
  point_.widthDeg = widthPx / pixelsPerDegree;
  const auto* fixedArea = std::get_if<FixedArea>(&settings.stimulusArea);
  point_.areaDeg2 = fixedArea ? fixedArea->deg2 : point_.widthDeg * heightPx / pixelsPerDegree;
  adaptation_ = adaptationBlend(settings, pixelsPerDegree, levels_);
  const int bands = std::max(levels_ - 2, 0);
  const PyramidSettings pyramid = settings.pyramid();
  peaks_ = settings.isTrueStack() && settings.peakModel != PeakModel::Halving
               ? stackBandPeaks(pyramid.kernel, bands, settings.stackSigmaPx())
               : bandPeaks(pyramid.kernel, pyramid.upsampler, settings.peakModel, bands);
  if (!settings.gainCompensation)
    for (BandPeak& peak : peaks_) peak.gain = 1.0;
  const bool needsPeaks = std::holds_alternative<ActualElevation>(settings.frequencyElevation) ||
                          settings.tvi.rfind("from_csf", 0) == 0;
  if (needsPeaks) {
    lnPeaks_.resize(kNodes);
    forRowBlocks(kNodes, 100000, [&](int first, int end) {
      for (int i = first; i < end; ++i)
        lnPeaks_[static_cast<size_t>(i)] =
            std::log(searchedPeak(std::pow(10.0, kLgLow + static_cast<double>(i) / kNodesPerDecade)));
    });
    // A cubic is off by 3/128 of the fourth difference at most, which is that small where the peak is smooth.
    constexpr double kLargestDifference = 4e-6;
    searched_.assign(kNodes, 0);
    for (int i = 2; i + 2 < kNodes; ++i) {
      const double* p = &lnPeaks_[static_cast<size_t>(i)];
      if (std::abs(p[-2] - 4.0 * p[-1] + 6.0 * p[0] - 4.0 * p[1] + p[2]) < kLargestDifference) continue;
      for (int cell = i - 2; cell <= i + 1; ++cell) searched_[static_cast<size_t>(cell)] = 1;
    }
  }
  if (const auto* original = std::get_if<OriginalElevation>(&settings.frequencyElevation))
    for (int band = 0; band < bands; ++band)
      originalF_.push_back(
          lowFrequencyOr(original->low, band, frequencyFactor(*csf_, at(band, original->luminanceCdM2))));
  if (settings.tvi.rfind("from_csf", 0) == 0) {
    // makeTvi() searches the peak at every call.
    const double scale = settings.tvi == "from_csf" ? 1.0 : tviWard(100.0) / (100.0 / peakSensitivity(100.0));
    tvi_ = [this, scale](double l) { return scale * l / peakSensitivity(l); };
  } else {
    tvi_ = makeTvi(settings.tvi, csf_, point_, "tvi");
  }
}

CsfPoint ThresholdModel::at(int band, double luminanceCdM2) const {
  CsfPoint point = point_;
  point.luminanceCdM2 = held(luminanceCdM2);
  if (band >= 0) point.frequencyCpd = peaks_[static_cast<size_t>(band)].frequencyCpd(pixelsPerDegree_);
  return point;
}

double ThresholdModel::searchedPeak(double luminanceCdM2) const {
  return std::max(csf_->peak(at(-1, luminanceCdM2)).sensitivity, 1.0 / kLargestElevation);
}

double ThresholdModel::peakSensitivity(double luminanceCdM2) const {
  if (lnPeaks_.empty()) return 0.0;
  const double lg = std::log10(held(luminanceCdM2));
  const double position = (std::clamp(lg, kLgLow, kLgHigh) - kLgLow) * kNodesPerDecade;
  const int i = std::min(static_cast<int>(position), kNodes - 2);
  if (searched_[static_cast<size_t>(i)]) return searchedPeak(luminanceCdM2);
  const double t = position - i;
  const auto p = [&](int k) { return lnPeaks_[static_cast<size_t>(std::clamp(k, 0, kNodes - 1))]; };
  // Through four nodes (Lagrange); at the ends the outer node repeats and the middle two still hold.
  const double a = p(i - 1), b = p(i), c = p(i + 1), d = p(i + 2);
  const double value = -t * (t - 1.0) * (t - 2.0) / 6.0 * a + (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0 * b -
                       (t + 1.0) * t * (t - 2.0) / 2.0 * c + (t + 1.0) * t * (t - 1.0) / 6.0 * d;
  return std::exp(value);
}

double ThresholdModel::tviCdM2(double luminanceCdM2) const { return tvi_(held(luminanceCdM2)); }

double ThresholdModel::thresholdCdM2(double elevation, double luminanceCdM2) const {
  return settings_.tviFactor * tviCdM2(luminanceCdM2) * elevation;
}

double ThresholdModel::sensitivity(int band, double luminanceCdM2) const {
  return csf_->sensitivity(at(band, luminanceCdM2));
}

double ThresholdModel::frequencyElevation(int band, double luminanceCdM2) const {
  const bool needsPeak = std::holds_alternative<ActualElevation>(settings_.frequencyElevation);
  return frequencyElevation(band, luminanceCdM2, needsPeak ? peakSensitivity(luminanceCdM2) : 0.0);
}

double ThresholdModel::frequencyElevation(int band, double luminanceCdM2, double peak) const {
  if (!originalF_.empty()) return originalF_[static_cast<size_t>(band)];
  const auto* actual = std::get_if<ActualElevation>(&settings_.frequencyElevation);
  if (!actual) return 1.0;
  const double here = sensitivity(band, luminanceCdM2);
  return lowFrequencyOr(actual->low, band,
                        peak >= kLargestElevation * here ? kLargestElevation : std::max(peak / here, 1.0));
}

double ThresholdModel::elevation(const std::vector<double>& contrasts, double luminanceCdM2) const {
  double weighted = 0.0, sum = 0.0;
  for (size_t band = 0; band < contrasts.size(); ++band) {
    const double c = contrasts[band] / peaks_[band].gain;
    if (!(c > 0.0)) continue;
    const int i = static_cast<int>(band);
    weighted +=
        c * frequencyElevation(i, luminanceCdM2) * maskingElevation(c * sensitivity(i, luminanceCdM2));
    sum += c;
  }
  if (const auto* smooth = std::get_if<SmoothFlat>(&settings_.flat))
    return std::max(1.0, (weighted + smooth->epsilon) / (sum + smooth->epsilon));
  return sum > 0.0 ? weighted / sum : 1.0;
}

}  // namespace limen::perception
