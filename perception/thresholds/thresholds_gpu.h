// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "perception/threshold_maps/threshold_maker.h"
#include "perception/thresholds/settings.h"
#include "perception/vision/display.h"
#include "renderer/gl/context.h"

namespace limen::perception {

/// Allocates and compiles for inputs of one format: colour (RGBA, linear, relative to `display`) or luminance
/// (one channel, cd/m2). Throws Error on settings that only computeThresholds() supports.
std::unique_ptr<ThresholdMaker> makeThresholds(gl::Context& context, glm::ivec2 sizePx,
                                               const DisplayProfile& display,
                                               const ThresholdGpuSettings& settings, bool colourInput = true);

}  // namespace limen::perception
