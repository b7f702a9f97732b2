// SPDX-License-Identifier: BSD-3-Clause
// First step: normals of the refined mesh from open or closed fans of its positions.
#include "renderer/techniques/subdivision/subdivision_bindings.h"

layout(local_size_x = kSubdivisionGroup) in;
layout(std430, binding = kControlEntriesBuffer) readonly buffer Entries { ControlEntry entries[]; };
layout(std430, binding = kFansBuffer) readonly buffer Fans { uint fans[]; };
layout(std430, binding = kControlsBuffer) buffer Controls { vec4 controls[]; };
uniform uint controlCount;

vec3 positionOf(uint vertex) { return controls[2u * vertex].xyz; }
#include "renderer/techniques/subdivision/fan_normal.glsl"

void main() {
  const uint c = gl_GlobalInvocationID.x;
  if (c >= controlCount) return;
  controls[2u * c + 1u] = vec4(fanNormal(positionOf(c), entries[c]), 0.0);
}
