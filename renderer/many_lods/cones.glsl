// SPDX-License-Identifier: BSD-3-Clause
// Cones of normals in 8 bytes. Twin of sphere_tree.cpp.
#include "renderer/many_lods/many_lods_bindings.h"

const float kConePi = 3.14159265358979;
const float kConeAxisStep = 1.0 / 16000.0;

vec3 unitOr(vec3 v) {
  const float reach = max(abs(v.x), max(abs(v.y), abs(v.z)));
  return reach > 0.0 ? normalize(v / reach) : vec3(0.0, 0.0, 1.0);
}

uvec2 packedCone(vec3 axis, float halfAngle) {
  vec2 at = axis.xy / (abs(axis.x) + abs(axis.y) + abs(axis.z));
  if (axis.z < 0.0) at = (1.0 - abs(at.yx)) * vec2(at.x < 0.0 ? -1.0 : 1.0, at.y < 0.0 ? -1.0 : 1.0);
  const uvec2 whole = uvec2(round((clamp(at, -1.0, 1.0) * 0.5 + 0.5) * 65534.0));
  return uvec2(whole.x | whole.y << 16u, uint(min(ceil((halfAngle + kConeAxisStep) / kConePi * 65535.0), 65535.0)));
}

vec3 coneAxis(uvec2 cone) {
  const vec2 at = vec2(cone.x & 0xffffu, cone.x >> 16u) / 32767.0 - 1.0;
  vec3 axis = vec3(at, 1.0 - abs(at.x) - abs(at.y));
  if (axis.z < 0.0) axis.xy = (1.0 - abs(at.yx)) * vec2(at.x < 0.0 ? -1.0 : 1.0, at.y < 0.0 ? -1.0 : 1.0);
  return normalize(axis);
}

float coneHalfAngle(uvec2 cone) { return float(cone.y) / 65535.0 * kConePi; }

uvec2 mergedCone(uvec2 first, uvec2 second) {
  const vec3 a = coneAxis(first), b = coneAxis(second);
  const float angleA = coneHalfAngle(first), angleB = coneHalfAngle(second);
  const float between = atan(length(cross(a, b)), dot(a, b));
  if (angleA >= angleB && between + angleB <= angleA) return packedCone(a, angleA + kConeSlack);
  if (angleB > angleA && between + angleA <= angleB) return packedCone(b, angleB + kConeSlack);
  const float halfAngle = 0.5 * (between + angleA + angleB);
  if (max(halfAngle, max(angleA, angleB)) >= kConePi) return packedCone(a, kConePi);
  vec3 side = b - a * dot(a, b);
  if (!(dot(side, side) > 1e-12)) {
    if (between < 1.0) return packedCone(a, halfAngle + kConeSlack);
    side = cross(a, abs(a.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
  }
  const float turn = halfAngle - angleA;
  return packedCone(normalize(a * cos(turn) + normalize(side) * sin(turn)), halfAngle + kConeSlack);
}
