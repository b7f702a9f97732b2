// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of ray casting are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
using glm::vec2;
#endif

struct PrismVertex {  // std430
  vec3 position;      // relative to the anchor
  uint patchNumber;
  vec2 start;  // (u, v) of the triangle under the vertex
  uint unused0, unused1;
};
#ifdef __cplusplus
static_assert(sizeof(PrismVertex) == 32 && offsetof(PrismVertex, start) == 16);
#endif

struct CurvedTriangle {  // std430; cubic, points in the order of patch_set.h
  vec4 points[10];       // relative to the anchor; w is unused
  vec4 normals[6];       // quadratic field
  uint material;
  uint hasNormals;
  uint unused0, unused1;
};
#ifdef __cplusplus
static_assert(sizeof(CurvedTriangle) == 272 && offsetof(CurvedTriangle, material) == 256);
#endif

const uint kCurvedTrianglesBuffer = 0u;
const uint kNewtonStepsImage = 0u;  // per pixel
const uint kStartsTriedImage = 1u;
const uint kPrismFragmentsImage = 2u;
const uint kSeenIdsUnit = 0u;
const uint kSeenNormalsUnit = 1u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
