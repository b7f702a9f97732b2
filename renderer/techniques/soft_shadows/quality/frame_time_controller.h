// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace limen::techniques {

struct FrameTimeSettings {
  double targetMs = 1.0;       ///< > 0
  double leastScale = 0.1;     ///< 0 < leastScale <= 1
  double gain = 0.25;          ///< share applied of the change that a sample calls for, 0 < gain <= 1
  double deadBand = 0.05;      ///< tolerated error of the time, as a share of the target
  double memory = 32.0;        ///< samples over which the cost model is fitted, >= 2
  double largestFactor = 4.0;  ///< largest factor by which one sample can change the scale, > 1
};

/// Finds the scale of all budgets, leastScale to 1, at which a frame takes the target time. Independent of
/// clock and GPU. Sources: Schwarz 2009, chapter 5 (a budget controls the frame time; table 5.1: time grows
/// with the number of micro-occluders); the control law is (derived):
///
/// Cost model: t = f + k scale. f, the part independent of the budget, is fitted by a line through past
/// samples; k follows from each sample. A sample (scale x, time t) thus calls for ln x + ln((target - f) / (t
/// - f)), whatever the scale is by then: delay does not invalidate it. The median of the last three samples,
/// which one slow frame cannot move, is followed with `gain`.
///
/// Stability: with true sensitivity s = d ln(t - f) / d ln x, a sample at a distance u from the correct ln x
/// calls for a point at (1 - s) u. The followed scale is a mean of itself and such points, of any age:
/// distances shrink whenever |1 - s| < 1. f is limited to 0.4 of time and target, so that s <= 1 / 0.6 if the
/// cost grows no faster than the budget; if f is missed altogether, s is only smaller.
///
/// Scale and followed point are clamped to the bounds, so an unreachable target causes no windup. The scale
/// stays constant while the followed point is within its dead band; once that leaves the band, the scale
/// follows until samples agree with it to within half the band.
class FrameTimeController {
 public:
  explicit FrameTimeController(const FrameTimeSettings& settings);

  /// Factor for all budgets of the next frame; 1 before the first sample.
  double scale() const;
  /// A frame's time and its scale. Times that are not positive numbers are ignored.
  void observe(double scale, double ms);

  int64_t samples() const { return samples_; }
  /// Smoothed time over target, minus 1; 0 before the first sample.
  double errorShare() const { return error_; }
  /// How often the smoothed error went from above the dead band to below it or back.
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
