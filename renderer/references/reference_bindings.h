// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of the references are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::references {
#endif

// Sampled light.
const uint kSampledLightReceiversUnit = 0u;
const uint kSampledLightNormalsUnit = 1u;
const uint kSampledLightDepthMapUnit = 2u;
const uint kSampledLightLitCountsImage = 0u;

// Its resolve.
const uint kSampledLightResolveReceiversUnit = 0u;
const uint kSampledLightResolveLitCountsImage = 0u;
const uint kSampledLightResolveVisibilityImage = 1u;

// Distribution ray tracing.
const uint kDistributionSumImage = 0u;

// Shadow rays (ComputeTracer). Doubles one by one: a dvec3 would be padded.
const uint kShadowRayLightBuffer = 0u;
const uint kShadowRayOutlineBuffer = 1u;
const uint kShadowRayReceiversBuffer = 2u;
const uint kShadowRayCountsBuffer = 3u;
const int kShadowRayGroup = 64;
const uint kShadowLightRectangle = 0u;
const uint kShadowLightDisc = 1u;
const uint kShadowLightPolygon = 2u;
const uint kShadowRayCutShort = 0x80000000u;  // in ShadowCounts::seen: the driver's limits were reached
struct ShadowLight {                          // std430
  double centreX, centreY, centreZ;           // relative to the anchor
  double rightX, rightY, rightZ;              // a whole width of the light's bounding rectangle
  double upX, upY, upZ;
  double planeTolerance;   // Triangles::planeTolerance()
  double cell;             // side of a cell of the grid over the light, a share of the light's
  uint shape;              // kShadowLight...
  uint outlineCount;       // triangles of a polygon
  uint side;               // cells along a side; 0: points lie anywhere
  uint part;               // of the light
  uint seedLow, seedHigh;  // mixBits(seed)
  float farEnd;            // of a ray, in its direction's units
  float nearDistance;      // hits nearer than this are tested again in double precision
};
struct ShadowReceiver {  // std430
  double x, y, z;        // relative to the anchor
  double normalX, normalY, normalZ;
  uint triangle, pixel;
};
struct OutlineTriangle {  // std430
  double ax, ay, bx, by, cx, cy;
  double share;  // of the area up to and including this triangle
};
struct ShadowCounts {  // std430
  uint seen;
  uint rays;  // not those to points behind the receiver's plane
};
#ifdef __cplusplus
static_assert(sizeof(ShadowLight) == 120 && offsetof(ShadowLight, shape) == 88 &&
              sizeof(ShadowReceiver) == 56 && sizeof(OutlineTriangle) == 56 && sizeof(ShadowCounts) == 8);
#endif

#ifdef __cplusplus
}  // namespace limen::references
#endif
