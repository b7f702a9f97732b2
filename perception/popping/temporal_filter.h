// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "perception/vision/castle_csf.h"

namespace limen::perception {

/// The mechanisms of castleCSF differ in how they respond to change over time: the sustained one prefers what
/// stays, the transient one responds to change only; colour is seen by sustained ones.
inline constexpr size_t kTemporalMechanisms = 4;
inline constexpr std::array<CastleMechanism, kTemporalMechanisms> kAllTemporalMechanisms = {
    CastleMechanism::Sustained, CastleMechanism::Transient, CastleMechanism::RedGreen,
    CastleMechanism::YellowViolet};

/// A mechanism's impulse response around a moment: symmetric in time, so that it has no delay, and sampled a
/// whole number of times a frame, at least kLeastTemporalRateHz. With 2 K + 1 samples its response at the
/// frequencies k / (2 K + 1) of the rate is castleTemporal() exactly (frequency sampling, as ColorVideoVDP
/// designs its filters, but at the bins themselves).
class TemporalFilter {
 public:
  /// `windowS`: how long it lasts, half before the moment and half after it.
  TemporalFilter(CastleMechanism mechanism, double luminanceCdM2, double refreshHz, double windowS);

  const std::vector<double>& taps() const { return taps_; }
  int samplesPerFrame() const { return samplesPerFrame_; }
  double rateHz() const { return rateHz_; }

  /// Response at each sample of a signal that is held during each frame; before the first and after the last
  /// frame it rests at these.
  std::vector<double> respond(const std::vector<double>& frames) const;
  /// Largest response, over time, to a pattern that appears at a moment and then moves so that it flickers at
  /// `hz`: the magnitude of sum_{j <= n} taps[j] exp(-2 pi i hz j / rate), at its largest over n. For 0 Hz
  /// the largest of the step response.
  double onset(double hz) const;

 private:
  int samplesPerFrame_;
  double rateHz_;
  std::vector<double> taps_;
};
inline constexpr double kLeastTemporalRateHz = 240.0;

/// Rows of OnsetTable for the transient mechanism, from castleCSF's kink to 1e4 cd/m2.
inline constexpr int kCastleKinkRows = 225;
/// onset() for any frequency and luminance, tabulated: bilinear over the logarithm of frequency and, of the
/// transient mechanism, a power of its best frequency at that luminance.
class OnsetTable {
 public:
  OnsetTable() = default;
  OnsetTable(CastleMechanism mechanism, double refreshHz, double windowS);
  double operator()(double hz, double luminanceCdM2) const;
  /// The same for all who ask for it: making one takes a tenth of a second.
  static std::shared_ptr<const OnsetTable> shared(CastleMechanism mechanism, double refreshHz,
                                                  double windowS);

 private:
  CastleMechanism mechanism_ = CastleMechanism::Sustained;
  double highestHz_ = 0.0;
  int rows_ = 0;  // of luminance; one where it does not matter
  std::vector<double> values_;
};

/// What remains of the contrast of a pattern of `cpd` on a display that shows each frame for `share` of its
/// time, while the eye moves over it with `eyeDegS`: the aperture's Fourier transform,
/// |sinc(cpd eyeDegS share / refreshHz)|. Watson 2013 (High frame rates and human vision: a view through the
/// window of visibility), among others.
double holdBlur(double cpd, double eyeDegS, double refreshHz, double share = 1.0);

}  // namespace limen::perception
