// SPDX-License-Identifier: BSD-3-Clause
// A scene's surfaces as SurfaceBuffers binds them.
#include "renderer/frame/frame_bindings.h"

layout(std430, binding = kSurfaceNormalsBuffer) readonly buffer Normals { float surfaceNormals[]; };
layout(std430, binding = kSurfaceAttributesBuffer) readonly buffer Attributes { vec4 surfaceAttributes[]; };
layout(std430, binding = kSurfaceTriangleMaterialsBuffer) readonly buffer TriangleMaterials { uint surfaceMaterialOf[]; };
layout(std430, binding = kSurfaceMaterialsBuffer) readonly buffer Materials { SurfaceMaterial surfaceMaterials[]; };

vec3 surfaceNormal(uint vertex) {
  return vec3(surfaceNormals[3u * vertex], surfaceNormals[3u * vertex + 1u], surfaceNormals[3u * vertex + 2u]);
}

// Uniform cubic B-spline basis and its derivative.
vec4 splineBasis(float t) {
  const float s = 1.0 - t;
  return vec4(s * s * s, 3.0 * t * t * t - 6.0 * t * t + 4.0, 3.0 * s * s * s - 6.0 * s * s + 4.0, t * t * t) / 6.0;
}
vec4 splineSlope(float t) {
  const float s = 1.0 - t;
  return vec4(-s * s, 3.0 * t * t - 4.0 * t, -3.0 * s * s + 4.0 * s, t * t) / 2.0;
}

// Unnormalised normal of a bicubic B-spline patch whose control points, i + 4 j, begin at attribute `first`: cross product
// of its derivatives.
vec3 patchNormal(uint first, vec2 uv) {
  const vec4 bu = splineBasis(uv.x), bv = splineBasis(uv.y), du = splineSlope(uv.x), dv = splineSlope(uv.y);
  vec3 alongU = vec3(0.0), alongV = vec3(0.0);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const vec3 point = surfaceAttributes[first + uint(i + 4 * j)].xyz;
      alongU += du[i] * bv[j] * point;
      alongV += bu[i] * dv[j] * point;
    }
  return cross(alongU, alongV);
}
