// SPDX-License-Identifier: BSD-3-Clause
// Normals of the control mesh itself, for Subdivision Shading from level 0: `entries` are the cage's.
#include "renderer/techniques/subdivision/subdivision_bindings.h"

layout(local_size_x = kSubdivisionGroup) in;
layout(std430, binding = kCagePositionsBuffer) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = kControlEntriesBuffer) readonly buffer Entries { ControlEntry entries[]; };
layout(std430, binding = kFansBuffer) readonly buffer Fans { uint fans[]; };
layout(std430, binding = kCageNormalsBuffer) writeonly buffer Normals { vec4 normals[]; };
uniform uint vertexCount;

vec3 positionOf(uint vertex) { return positions[vertex].xyz; }
#include "renderer/techniques/subdivision/fan_normal.glsl"

void main() {
  const uint v = gl_GlobalInvocationID.x;
  if (v >= vertexCount) return;
  normals[v] = vec4(fanNormal(positions[v].xyz, entries[v]), 0.0);
}
