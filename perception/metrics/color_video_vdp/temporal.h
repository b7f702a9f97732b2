// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "experiments/base/enum_names.h"
#include "perception/metrics/color_video_vdp/parameters.h"

namespace limen::perception::cvvdp {

/// What the eye saw before the first frame.
enum class TemporalPadding {
  Replicate,  ///< the first frame
  Symmetric   ///< the video backwards
};
constexpr EnumNames<TemporalPadding, 2> enumNames(TemporalPadding) {
  return {{{{TemporalPadding::Replicate, "replicate"}, {TemporalPadding::Symmetric, "symmetric"}}}};
}

/// Length of the temporal filters at this frame rate: odd, about a quarter of a second.
int temporalTaps(double framesPerSecond);
/// Taps of a channel's filter; the first is for the current frame, tap j for the one j frames earlier.
std::vector<double> temporalFilter(int channel, double framesPerSecond);
/// The frame of a video of `frames` frames that stands for `frame`, which may be before the first. A
/// symmetric video needs two.
int paddedFrame(int frame, int frames, TemporalPadding padding);

}  // namespace limen::perception::cvvdp
