// SPDX-License-Identifier: BSD-3-Clause
// Overlaps of many triangles with the unit disk.
#include "renderer/techniques/reflections/cones/cone_bindings.h"
#include "renderer/techniques/reflections/cones/disk_overlap.glsl"

layout(local_size_x = kOverlapGroup) in;
layout(std430, binding = kOverlapTrianglesBuffer) readonly buffer Triangles { vec4 triangles[]; };
layout(std430, binding = kOverlapsBuffer) writeonly buffer Overlaps { vec4 overlaps[]; };
uniform uint count;

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  const vec4 first = triangles[2u * i];
  vec2 corners[4];
  corners[0] = first.xy;
  corners[1] = first.zw;
  corners[2] = triangles[2u * i + 1u].xy;
  corners[3] = vec2(0.0);
  overlaps[i] = vec4(diskOverlap(corners, 3), 0.0);
}
