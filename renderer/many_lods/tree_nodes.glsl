// SPDX-License-Identifier: BSD-3-Clause
// Spheres of a tree's nodes: of inner ones from their children's, and, LEAVES, of leaves from the triangles where they are now. Twins:
// mergedSphere() and positionOf() in C++.
#include "renderer/many_lods/many_lods_bindings.h"
#ifdef LEAVES
layout(std430, binding = kUpdatePositionsBuffer) readonly buffer Positions { float positions[]; };
layout(std430, binding = kUpdateIndicesBuffer) readonly buffer Indices { uint indices[]; };
layout(std430, binding = kUpdatePointsBuffer) readonly buffer Points { uvec2 points[]; };
#endif


uniform float leafRadius;

vec4 mergedSphere(vec4 a, vec4 b) {
  const vec3 apart = b.xyz - a.xyz;
  const float distance_ = length(apart);
  const float along = distance_ > 0.0 ? 0.5 + (b.w - a.w) / (2.0 * distance_) : 0.0;
  const vec3 centre = a.xyz + apart * clamp(along, 0.0, 1.0);
  return vec4(centre, max(distance(a.xyz, centre) + a.w, distance(b.xyz, centre) + b.w) * (1.0 + kSphereSlack));
}

#ifdef LEAVES
vec3 cornerOf(uint triangle, uint corner) {
  const uint at = 3u * indices[3u * triangle + corner];
  return vec3(positions[at], positions[at + 1u], positions[at + 2u]);
}

vec4 leafOf(uint index, out vec3 normal) {
  const uvec2 point = points[index];
  const vec3 a = cornerOf(point.x, 0u), b = cornerOf(point.x, 1u), c = cornerOf(point.x, 2u);
  const float s = float(point.y & 0xffffu) / 65535.0, t = float(point.y >> 16u) / 65535.0;
  normal = cross(b - a, c - a);
  return vec4(a * (1.0 - s - t) + b * s + c * t, leafRadius);
}
#endif
