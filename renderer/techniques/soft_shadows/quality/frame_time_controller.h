// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace limen::techniques {

struct FrameTimeSettings {
  double targetMs = 1.0;       ///< > 0
  double leastScale = 0.1;     ///< 0 < leastScale <= 1
  double gain = 0.25;          ///< share of what a sample asks for that is followed, 0 < gain <= 1
  double deadBand = 0.05;      ///< error of the time, as a share of the target, that is left alone
  double memory = 32.0;        ///< samples over which the cost model is fitted, >= 2
  double largestFactor = 4.0;  ///< by which one sample can ask for a change of the scale, > 1
};

/// Finds the scale, leastScale to 1, of all budgets at which a frame takes the target's time. Knows neither
/// clock nor GPU. Sources: Schwarz 2009, chapter 5 (a budget steers the frame's time; table 5.1: time goes
/// with the number of micro-occluders); the control law is (derived):
///
/// Cost model: t = f + k scale. f, what no budget changes, is fitted by a line through past samples, k
/// follows from each sample. A sample (scale x, time t) so asks for ln x + ln((target - f) / (t - f)),
/// whatever the scale has become since: delay does not make it wrong. The median of the last three samples,
/// which one slow frame cannot move, is followed by `gain`.
///
/// Stability: with true sensitivity s = d ln(t - f) / d ln x, a sample at a distance u from the right ln x
/// asks for a point at (1 - s) u. The scale followed is a mean of itself and of such points, of any age:
/// distances shrink whenever |1 - s| < 1. f is held to 0.4 of time and target, so that s <= 1 / 0.6 where the
/// cost grows no faster than the budget; where f is missed altogether, s is only smaller.
///
/// Scale and followed point end at the bounds, so a cost that cannot be met winds nothing up. The scale keeps
/// still while the followed point is within the dead band of it; once that leaves, the scale goes along until
/// samples agree with it within half of the band.
class FrameTimeController {
 public:
  explicit FrameTimeController(const FrameTimeSettings& settings);

  /// Factor for all budgets of the next frame; 1 before the first sample.
  double scale() const;
  /// A frame's time and the scale that it had. Times that are no positive numbers are passed over.
  void observe(double scale, double ms);

  int64_t samples() const { return samples_; }
  /// Smoothed time over target, less 1; 0 before the first sample.
  double errorShare() const { return error_; }
  /// Times that the smoothed error went from above the dead band to below it or back.
  int oscillations() const { return oscillations_; }
  /// f of the cost model.
  double fixedMs() const { return fixedMs_; }

 private:
  void fit(double scale, double ms);

  FrameTimeSettings settings_;
  double followed_ = 0.0, held_ = 0.0;  // ln of scales
  bool moving_ = false;
  std::array<double, 3> asked_{};
  int64_t samples_ = 0;
  // Means and sums of products around them, with forgetting.
  double weight_ = 0.0, meanScale_ = 0.0, meanMs_ = 0.0, scaleSquares_ = 0.0, products_ = 0.0;
  double fixedMs_ = 0.0;
  double error_ = 0.0;
  int side_ = 0, oscillations_ = 0;
};

}  // namespace limen::techniques
