// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/techniques/soft_shadows/quality/level_of_quality.h"
#include "renderer/techniques/soft_shadows/quality/level_steps.h"
#include "renderer/techniques/soft_shadows/visibility_pass.h"

namespace limen::techniques {

/// Steps between the levels that pixels have chosen, found by the technique's own shader once a map's pixels
/// are counted; none if all processed pixels use the same levels. Waits for the GPU.
std::optional<LevelSteps> findLevelSteps(frame::Frame& frame, const VisibilityPass& pass, PassInputs& inputs,
                                         const frame::ShadowMapSettings& map, const LevelOfQuality& quality,
                                         const CountImages& images, const PixelCounts& counted);

}  // namespace limen::techniques
