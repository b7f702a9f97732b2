// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/image.h"

namespace limen::perception {

/// What a frame would look like if nothing had happened since the previous one but motion.
struct CompensatedFrame {
  Image picture;       ///< the previous frame moved along the flow, channels of `before`
  Image displacement;  ///< optical flow [px], 2 channels
  /// 1 where the flow is believed, 0 where it is not: the way back does not lead to where it came from (by
  /// more than a pixel and a twentieth of the way), or it came from outside the picture. There `picture` is
  /// `now`.
  Image weight;
};

/// `before` and `now` may be in any unit; `flowBefore` and `flowNow` are the same pictures as pixel values in
/// [0, 1], from which the flow is found. All of the same size. Places between pixels are interpolated
/// bilinearly.
CompensatedFrame compensateMotion(const Image& before, const Image& now, const Image& flowBefore,
                                  const Image& flowNow);

}  // namespace limen::perception
