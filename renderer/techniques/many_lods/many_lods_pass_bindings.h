// SPDX-License-Identifier: BSD-3-Clause
// What the techniques over trees of points are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// Light of leaves. 0 to 5 are the scene's and its surfaces'.
const int kLeafColoursGroup = 256;
const uint kLeafSamplesBuffer = 6u;
const uint kLeafColoursBuffer = 7u;

// Picture of a single view.
const uint kPointsDepthsBuffer = 0u;
const uint kPointsWinnersBuffer = 1u;
const uint kPointsColoursBuffer = 2u;
const uint kPointsImage = 0u;

// Virtual point lights.
struct VirtualLight {  // std430; relative to the anchor
  vec4 position;       // w: 1; 0: there is no light, as its ray met nothing
  vec4 normal;         // unit, on the lit side; w: number of its triangle, as bits
  vec4 flux;           // that leaves it [W]; w: unused
};
#ifdef __cplusplus
static_assert(sizeof(VirtualLight) == 48);
#endif
const int kVirtualLightsGroup = 64;
const uint kVirtualLightsBuffer = 0u;  // 2 and 5 are the surfaces', 6 and 7 the rays'
const uint kVirtualViewsBuffer = 1u;

// Their light on what the camera sees.
const uint kRadiosityLightsBuffer = 0u;
const uint kRadiosityViewsBuffer = 1u;
const uint kRadiosityDepthsBuffer = 2u;
const uint kRadiosityCountsBuffer = 3u;
const int kRadiosityBatch = 64;          // lights that a group holds at a time
const float kRadiosityMostSlope = 4.0f;  // that biases follow
const uint kRadiosityPositionsUnit = 0u;
const uint kRadiosityNormalsUnit = 1u;
const uint kRadiosityAlbedosUnit = 2u;
const uint kRadiosityIdsUnit = 3u;
const uint kRadiosityImage = 0u;

// Light of leaves from the scene's light. 0, 1, 2 and 5 are the scene's, 6 and 7 the rays'.
const uint kLitSamplesBuffer = 3u;
const uint kLitColoursBuffer = 4u;

// What views of receivers gather.
const int kGatherGroup = 64;
const uint kGatherViewsBuffer = 0u;
const uint kGatherDepthsBuffer = 1u;
const uint kGatherWinnersBuffer = 2u;
const uint kGatherColoursBuffer = 3u;
const uint kGatheredBuffer = 4u;
const uint kGatherPositionsUnit = 0u;
const uint kGatherNormalsUnit = 1u;
const uint kGatherAlbedosUnit = 2u;
const uint kGatherImage = 0u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
