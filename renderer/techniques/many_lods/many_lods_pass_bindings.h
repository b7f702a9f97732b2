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
const uint kCameraViewsUnit = 0u;  // of several views of a camera

// Virtual point lights.
struct VirtualLight {  // std430; relative to the anchor
  vec4 position;       // w: kLight...; of a distant one the unit vector towards it
  vec4 normal;         // unit, on the lit side; w: number of its triangle, as bits
  vec4 flux;           // that leaves it [W], of a distant one its irradiance [W / m^2]; w: unused
};
#ifdef __cplusplus
static_assert(sizeof(VirtualLight) == 48);
#endif
const float kLightNone = 0.0f;  // its ray met nothing
const float kLightPoint = 1.0f;
const float kLightDistant = 2.0f;
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

// Triangles in tiles. 0 and 1 are the scene's.
const int kPolygonGroup = 128;
const int kSmallPolygonPx = 64;  // boxes of more pixels are drawn by the whole group
const uint kPolygonViewsBuffer = 2u;
const uint kPolygonDepthsBuffer = 3u;

// Light that rays gather. 0, 1, 2 and 5 are the scene's, 6 and 7 the rays'.
const uint kRayGatherPositionsUnit = 0u;
const uint kRayGatherNormalsUnit = 1u;
const uint kRayGatherAlbedosUnit = 2u;
const uint kRayGatherIdsUnit = 3u;
const uint kRayGatherSumsImage = 0u;
const uint kRayGatherSumsUnit = 0u;
const uint kRayGatherImage = 1u;

// Probes. Otherwise as what views gather.
const int kProbeTerms = 9;  // spherical harmonics up to the second order
const uint kProbesBuffer = 4u;
const uint kProbeImage = 0u;

// Maps of what objects reflect.
const uint kMapViewsBuffer = 0u;
const uint kMapDepthsBuffer = 1u;
const uint kMapWinnersBuffer = 2u;
const uint kMapColoursBuffer = 3u;
const uint kMapOriginsUnit = 0u;
const uint kMapDirectionsUnit = 1u;
const uint kMapIdsUnit = 2u;
const uint kMapObjectsUnit = 3u;
const uint kMapPixelsUnit = 4u;
const uint kMapReflectedImage = 0u;
const uint kTracedMapViewsUnit = 0u;
const uint kTracedMapImage = 1u;
const int kMapRow = 32;            // views beside each other in a texture of maps
const int kMapObjectsWidth = 1024;  // of a texture of triangles' objects

// What views of receivers gather.
const int kGatherGroup = 64;
const uint kGatherViewsBuffer = 0u;
const uint kGatherDepthsBuffer = 1u;
const uint kGatherWinnersBuffer = 2u;
const uint kGatherColoursBuffer = 3u;
const uint kGatheredBuffer = 4u;
const uint kGatherConesBuffer = 5u;
const uint kGatherPositionsUnit = 0u;
const uint kGatherNormalsUnit = 1u;
const uint kGatherAlbedosUnit = 2u;
const uint kGatherImage = 0u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
