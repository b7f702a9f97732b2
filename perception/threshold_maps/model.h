// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "perception/threshold_maps/settings.h"
#include "perception/vision/csf.h"
#include "perception/vision/masking.h"

namespace limen::perception {

/// Adaptation luminance as a blend of two levels: (1 - next) G_level + next G_level+1.
struct AdaptationBlend {
  int level = 0;
  double next = 0.0;
};
/// For `levels` Gaussian levels at `pixelsPerDegree`. A level's width is that of the Gaussian of its variance
/// (upsampling included) as the step edge shows it: 1 / the steepest slope.
AdaptationBlend adaptationBlend(const ThresholdMapSettings& settings, double pixelsPerDegree, int levels);
double levelWidthPx(const ThresholdMapSettings& settings, int level);

/// The psychophysical part of a threshold map, bound to one image size and viewing distance: everything
/// needed to compute dL from adaptation luminance and contrasts. Luminances are clamped to 1e-4 to 1e6 cd/m2.
class ThresholdModel {
 public:
  /// Throws Error on unknown names.
  ThresholdModel(const ThresholdMapSettings& settings, double pixelsPerDegree, int widthPx, int heightPx);
  ThresholdModel(const ThresholdModel&) = delete;
  ThresholdModel& operator=(const ThresholdModel&) = delete;

  int levels() const { return levels_; }                         ///< Gaussian levels that the image has
  int bands() const { return static_cast<int>(peaks_.size()); }  ///< contrast levels: two fewer, or none
  /// Where each band peaks; the gain is 1 unless it is to be compensated.
  const std::vector<BandPeak>& peaks() const { return peaks_; }
  const AdaptationBlend& adaptation() const { return adaptation_; }

  /// Peak over frequency: a smooth function of luminance, and the most expensive part. Interpolated by cubics
  /// through 100 nodes per decade (relative error below 1e-7), and searched anew between nodes where it is
  /// not smooth: castleCSF's rises by a factor of 1.8 from 0.0113 to 0.0114 cd/m2.
  double peakSensitivity(double luminanceCdM2) const;
  double sensitivity(int band, double luminanceCdM2) const;
  /// Whether sensitivities change at once at castleKinkCdM2().
  bool hasCastleKink() const {
    return settings_.csf == "castlecsf" || settings_.csf == "castlecsf_transient";
  }
  /// F: threshold elevation by frequency.
  double frequencyElevation(int band, double luminanceCdM2) const;
  /// With peakSensitivity() at that luminance given.
  double frequencyElevation(int band, double luminanceCdM2, double peak) const;
  /// T_D: threshold elevation by contrast; `c` is CSF-normalised.
  double maskingElevation(double c) const { return masking_.elevation(c); }
  double tviCdM2(double luminanceCdM2) const;
  /// S of |contrasts| at an adaptation luminance.
  double elevation(const std::vector<double>& contrasts, double luminanceCdM2) const;
  double thresholdCdM2(double elevation, double luminanceCdM2) const;

 private:
  CsfPoint at(int band, double luminanceCdM2) const;
  double searchedPeak(double luminanceCdM2) const;
  template <class Low>
  double lowFrequencyOr(const Low& low, int band, double elevation) const;

  ThresholdMapSettings settings_;
  double pixelsPerDegree_;
  int levels_;
  std::shared_ptr<const Csf> csf_;
  Masking masking_;
  CsfPoint point_;
  std::vector<BandPeak> peaks_;
  AdaptationBlend adaptation_;
  std::vector<double> lnPeaks_;    ///< ln of the peak sensitivity at the nodes
  std::vector<char> searched_;     ///< after which nodes it is not interpolated
  std::vector<double> originalF_;  ///< of each band
  std::function<double(double)> tvi_;
};

}  // namespace limen::perception
