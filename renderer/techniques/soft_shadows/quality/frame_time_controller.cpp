// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/frame_time_controller.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace limen::techniques {
namespace {

/// Bound on the fixed part of the cost as a share of time and target; see the class.
constexpr double kMostFixed = 0.4;
/// Scales must spread by this share of their mean for a line through them: with times known to 5 % and 16
/// samples, its slope is then known to 12 %.
constexpr double kLeastSpread = 0.1;

}  // namespace

FrameTimeController::FrameTimeController(const FrameTimeSettings& settings) : settings_(settings) {
  assert(settings.targetMs > 0.0 && settings.leastScale > 0.0 && settings.leastScale <= 1.0);
  assert(settings.gain > 0.0 && settings.gain <= 1.0 && settings.memory >= 2.0 &&
         settings.largestFactor > 1.0);
}

double FrameTimeController::scale() const { return std::exp(held_); }

void FrameTimeController::fit(double scale, double ms) {
  const double keep = 1.0 - 1.0 / settings_.memory;
  weight_ = keep * weight_ + 1.0;
  const double away = scale - meanScale_;
  meanScale_ += away / weight_;
  meanMs_ += (ms - meanMs_) / weight_;
  scaleSquares_ = keep * scaleSquares_ + away * (scale - meanScale_);
  products_ = keep * products_ + away * (ms - meanMs_);
  // Otherwise the last line remains valid: a constant scale says nothing about the slope.
  if (scaleSquares_ / weight_ >= kLeastSpread * kLeastSpread * meanScale_ * meanScale_ && products_ > 0.0)
    fixedMs_ = std::max(0.0, meanMs_ - products_ / scaleSquares_ * meanScale_);
}

void FrameTimeController::observe(double scale, double ms) {
  if (!(ms > 0.0) || !std::isfinite(ms) || !(scale > 0.0) || !std::isfinite(scale)) return;
  fit(scale, ms);
  const double target = settings_.targetMs;
  const double fixed = std::min(fixedMs_, kMostFixed * std::min(ms, target));
  const double most = std::log(settings_.largestFactor), least = std::log(settings_.leastScale);
  const double step = std::clamp(std::log((target - fixed) / (ms - fixed)), -most, most);
  // The first sample substitutes for the two missing ones.
  if (samples_ == 0) asked_.fill(std::log(scale) + step);
  asked_[static_cast<size_t>(samples_ % 3)] = std::log(scale) + step;
  ++samples_;
  const double asked =
      std::max(std::min(asked_[0], asked_[1]), std::min(std::max(asked_[0], asked_[1]), asked_[2]));
  followed_ = std::clamp(followed_ + settings_.gain * (asked - followed_), least, 0.0);

  // The effect of a change of ln scale on the time, near the target.
  const double sensitivity = (target - fixed) / target;
  if (std::abs(followed_ - held_) * sensitivity > settings_.deadBand) moving_ = true;
  if (moving_) {
    held_ = followed_;
    // Beyond a bound the target can never be met: the scale goes all the way to the bound.
    moving_ = std::abs(asked - followed_) * sensitivity > 0.5 * settings_.deadBand;
  }

  const double share = ms / target - 1.0;
  error_ = samples_ == 1 ? share : error_ + settings_.gain * (share - error_);
  const int side = error_ > settings_.deadBand ? 1 : error_ < -settings_.deadBand ? -1 : 0;
  if (side != 0 && side_ != 0 && side != side_) ++oscillations_;
  if (side != 0) side_ = side;
}

}  // namespace limen::techniques
