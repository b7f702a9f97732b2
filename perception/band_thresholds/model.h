// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "perception/band_thresholds/settings.h"
#include "perception/popping/predictor.h"
#include "perception/popping/sensitivity.h"
#include "perception/vision/display.h"

namespace limen::perception {

/// The predictor of channel A, inverted, for one image size and display: by how much a band's contrast may
/// change at a pixel before its response changes by `jnd`. Contrasts are those of the predictor,
/// c = (G_i - up G_i+1) / (up up G_i+2 gain).
class BandThresholdModel {
 public:
  /// Throws Error on unusable settings.
  BandThresholdModel(const BandThresholdSettings& settings, const DisplayProfile& display, int widthPx,
                     int heightPx);

  const PoppingModel& predictor() const { return model_; }
  int bands() const { return model_.contrastLevels; }

  /// Of |c| times the sensitivity: the largest s such that no change of up to s, to either side, changes the
  /// response by more than `jnd`.
  double step(double normalised) const { return step_(normalised); }
  /// Calibrated sensitivity of a band to luminance contrast, for a fixating eye; luminances are held between
  /// 1e-4 and 1e6 cd/m2.
  double sensitivity(int band, double luminanceCdM2) const;
  /// Largest change of contrast; `contrast` is the band's magnitude.
  double contrastStep(int band, double contrast, double luminanceCdM2) const;

  /// Sum of the magnitudes of the filter that makes band `band`, over its gain: a difference of at most 1 at
  /// every pixel changes (G_i - up G_i+1) / gain by at most this.
  double spread(int band) const { return spreads_[static_cast<size_t>(band)]; }
  /// Largest difference of any spectrum whose magnitude is at most this around a pixel [cd/m2]. It changes
  /// the numerator of a contrast by at most spread(), its denominator and the luminance adapted to, on which
  /// the sensitivity depends at most with a power of 1/2, by itself.
  double anySpectrumCdM2(int band, double contrast, double contrastStep, double denominatorCdM2) const {
    return contrastStep * denominatorCdM2 / (spread(band) + 1.5 * contrast + contrastStep);
  }
  /// Where an image is too small for bands: the contrast threshold of the frequency that is most visible at
  /// 100 cd/m2, as a share of the luminance [cd/m2].
  double uniformCdM2(double luminanceCdM2) const;

 private:
  BandThresholdSettings settings_;
  PoppingModel model_;
  Sensitivity sensitivity_;
  double velocityDegS_, peakSensitivity_ = 1.0;
  FineTable step_;
  std::vector<double> spreads_;
};

}  // namespace limen::perception
