// SPDX-License-Identifier: BSD-3-Clause
// What the shader of the triangle bitmask is bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// Bounding-volume hierarchy over triangles (triangle_bvh.h).
struct BvhNode {  // std430
  vec3 low;
  uint skip;  // next node where this box is of no interest
  vec3 high;
  uint leaf;  // first triangle * 8 + number of triangles; 0: inner node
};
struct BvhTriangle {  // std430
  vec3 a;
  uint id;  // as given to build
  vec3 b;
  uint padding0;
  vec3 c;
  uint padding1;
};
#ifdef __cplusplus
static_assert(sizeof(BvhNode) == 32 && offsetof(BvhNode, high) == 16 && offsetof(BvhNode, leaf) == 28);
static_assert(sizeof(BvhTriangle) == 48 && offsetof(BvhTriangle, b) == 16 && offsetof(BvhTriangle, c) == 32);
#endif

const uint kTriangleBitmaskReceiversUnit = 0u;
const uint kTriangleBitmaskIdsUnit = 1u;
const uint kTriangleBitmaskVisibilityImage = 0u;
const uint kTriangleBitmaskPlanesBuffer = 2u;
const uint kTriangleBitmaskLightShapeBuffer = 3u;
const uint kTriangleBitmaskCountsImage = 1u;
const uint kTriangleBitmaskMasksBuffer = 4u;
const uint kTriangleBitmaskNodesBuffer = 0u;
const uint kTriangleBitmaskTrianglesBuffer = 1u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
