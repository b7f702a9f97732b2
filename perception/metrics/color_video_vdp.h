// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "experiments/base/image.h"
#include "perception/vision/display.h"

namespace limen::gl {
class Context;
}

namespace limen::perception {

/// Frames of light relative to the display's white, by index: 1, 3 or 4 channels.
struct LightPair {
  glm::ivec2 sizePx{0};
  int frames = 1;                ///< 1: an image
  double framesPerSecond = 0.0;  ///< of a video
  std::function<Image(int)> test, reference;
};

/// ColorVideoVDP of a pair on a display [JOD], computed on the GPU: 10 for no visible difference. Throws
/// Error: sides below 4 pixels, a video without a frame rate. Source: Mantiuk et al., "ColorVideoVDP", ACM
/// Transactions on Graphics 43(4), 2024.
double colorVideoVdpJod(gl::Context& context, const LightPair& pair, const DisplayProfile& display);

}  // namespace limen::perception
