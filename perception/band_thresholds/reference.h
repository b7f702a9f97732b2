// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "perception/band_thresholds/model.h"
#include "perception/multiscale/plane.h"

namespace limen::perception {

/// Thresholds of one frequency band, at the size of its pyramid level.
struct BandThreshold {
  double frequencyCpd = 0.0;
  Plane thresholdCdM2;    ///< of the band of a luminance difference, dG_i - up dG_i+1
  Plane anySpectrumCdM2;  ///< of a luminance difference, whatever its frequencies, that is no larger around
  /// The image's: c, its denominator, and the filter's gain, by which a band is divided.
  Plane contrast, denominatorCdM2;
  double gain = 1.0;
};

struct BandThresholds {
  std::vector<BandThreshold> bands;  ///< finest first; none for images too small for a band
  Plane combinedCdM2;                ///< at each pixel: below it no band's response changes visibly
  Plane limitingBand;                ///< whose threshold the combined one is there
  int64_t guarded = 0;               ///< contrasts, over all bands, whose denominator was too small
};

/// Thresholds that invert the popping predictor's luminance channel (settings.predictor; double precision,
/// the reference for the GPU's). Of the bands: a difference that consists of band i alone and stays below
/// bands[i] leaves the predictor's response of that band within settings.jnd; see compareWithThresholds() for
/// all others.
/// Combined: a difference that stays below `combinedCdM2` at every pixel leaves all bands within it,
/// whatever its frequencies.
///
/// For luminance differences that keep a pixel's chromaticity, as light does; an even change of the whole
/// image is no contrast and has no threshold here. NaN and negative luminances count as 0.
BandThresholds computeBandThresholds(const Plane& luminanceCdM2, const DisplayProfile& display,
                                     const BandThresholdSettings& settings);

/// The map of one value per pixel that settings.output asks for. Throws Error on a band that there is not.
Plane thresholdMapOf(const BandThresholds& thresholds, const BandThresholdSettings& settings);

/// A difference split into the bands of computeBandThresholds(), and the ratio to their thresholds: at each
/// pixel the Minkowski sum over the bands, with the predictor's exponent. At most 1: not visible.
struct BandRatios {
  /// Of each band, at its size, signed. What a difference's coarser bands do to the contrast's denominator
  /// counts too.
  std::vector<Plane> ratios;
  Plane pooled;  ///< at full size
};
BandRatios compareWithThresholds(const Plane& differenceCdM2, const BandThresholds& thresholds,
                                 const BandThresholdSettings& settings);

}  // namespace limen::perception
