// SPDX-License-Identifier: BSD-3-Clause
// The control mesh in its pose: linear blend skinning of each vertex with one joint.
#include "renderer/techniques/subdivision/subdivision_bindings.h"

layout(local_size_x = kSubdivisionGroup) in;
layout(std430, binding = kCageRestBuffer) readonly buffer Rest { CageVertex rest[]; };
layout(std430, binding = kCageJointsBuffer) readonly buffer Joints { mat4 joints[]; };
layout(std430, binding = kCagePositionsBuffer) writeonly buffer Positions { vec4 positions[]; };
uniform uint vertexCount;

void main() {
  const uint v = gl_GlobalInvocationID.x;
  if (v >= vertexCount) return;
  const CageVertex vertex = rest[v];
  vec3 p = vertex.rest;
  if (vertex.weight != 0.0) p = mix(p, (joints[vertex.joint] * vec4(p, 1.0)).xyz, vertex.weight);
  positions[v] = vec4(p, 1.0);
}
