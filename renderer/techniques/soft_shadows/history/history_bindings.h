// SPDX-License-Identifier: BSD-3-Clause
// What the shader of the visibility history is bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// What became of a pixel's past.
const uint kFateNoReceiver = 0u;
const uint kFateNoPast = 1u;
const uint kFatePastTaken = 2u;
const uint kFatePastBounded = 3u;

const uint kHistoryReceiversUnit = 0u;
const uint kHistoryPresentVisibilityUnit = 1u;
const uint kHistoryDepthsUnit = 2u;
const uint kHistoryNormalsUnit = 3u;
const uint kHistoryPastVisibilityUnit = 4u;
const uint kHistoryPastSurfaceUnit = 5u;
const uint kHistoryDisplacementUnit = 6u;
const uint kHistoryPreviousDepthUnit = 7u;
const uint kHistoryFateImage = 0u;
const uint kHistoryVisibilityImage = 0u;
const uint kHistorySurfaceImage = 1u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
