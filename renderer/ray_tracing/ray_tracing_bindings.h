// SPDX-License-Identifier: BSD-3-Clause
// What shaders that trace rays are bound to (trace.glsl). For C++ and GLSL. Storage buffers 0 to 5 are left
// to the shader that includes it; 8 are granted.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::ray_tracing {
#endif

const uint kRayNodesBuffer = 6u;
const uint kRayTrianglesBuffer = 7u;

// Levels of a tree built on the CPU; levels of any tree, and entries of the traversal's stack.
const int kRayLevels = 20;
const int kRayStack = 32;
const uint kRayNoTriangle = 0xffffffffu;
const uint kRayNoRoot = 0xffffffffu;  // of an object without a tree (RayForest)
const float kRayFarthest = 3.0e38f;  // `far` of a ray without end

// Rays given in a buffer (RayBatch).
const uint kRayBatchRaysBuffer = 0u;
const uint kRayBatchHitsBuffer = 1u;
const int kRayBatchGroup = 64;
struct BatchRay {  // std430
  vec3 origin;
  float near;  // hits lie in near < t <= far; in units of the direction
  vec3 direction;
  float far;
};
struct BatchHit {  // std430
  float t;         // NaN: the ray was cut short
  uint triangle;   // of the scene; kRayNoTriangle: none. With any hits, of one of them
  float u, v;      // barycentric coordinates of the second and third vertex
};
#ifdef __cplusplus
static_assert(sizeof(BatchRay) == 32 && offsetof(BatchRay, direction) == 16 && sizeof(BatchHit) == 16);
#endif

#ifdef __cplusplus
}  // namespace limen::ray_tracing
#endif
