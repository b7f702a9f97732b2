// SPDX-License-Identifier: BSD-3-Clause
// A vertex of the control mesh in its pose: linear blend skinning with one of JOINTS joints.

layout(std430, binding = kCageRestBuffer) readonly buffer Rest { CageVertex rest[]; };
// Uniforms reach a dispatch without a copy that it would wait for.
#if JOINTS <= MOST_UNIFORM_JOINTS
uniform mat4 joints[max(JOINTS, 1)];
#else
layout(std430, binding = kCageJointsBuffer) readonly buffer Joints { mat4 joints[]; };
#endif

vec3 skinned(uint v) {
  const vec3 p = rest[v].rest;
  const float weight = rest[v].weight;
  return weight == 0.0 ? p : mix(p, (joints[rest[v].joint] * vec4(p, 1.0)).xyz, weight);
}
