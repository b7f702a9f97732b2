// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/color_video_vdp.h"

#include "perception/metrics/color_video_vdp/color_video_vdp_gpu.h"

namespace limen::perception {

double colorVideoVdpJod(gl::Context& context, const LightPair& pair, const DisplayProfile& display) {
  cvvdp::Options options;
  options.display = cvvdp::displayOf(display);
  options.values = cvvdp::Values::Relative;
  options.framesPerSecond = pair.framesPerSecond;
  return cvvdp::evaluateOnGpu(context, {pair.sizePx.x, pair.sizePx.y, pair.frames, pair.test, pair.reference},
                              options)
      .jod;
}

}  // namespace limen::perception
