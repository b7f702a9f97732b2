// SPDX-License-Identifier: BSD-3-Clause
// Writes the depth range that a structure gives for each of many areas, for comparison with brute force.
#include "tests/renderer/techniques/readback_bindings.h"
#include "renderer/techniques/soft_shadows/depth_bounds.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = kDepthBoundsReadbackAreasBuffer) readonly buffer Areas { ivec4 areas[]; };  // [low, high)
layout(std430, binding = kDepthBoundsReadbackRangesBuffer) writeonly buffer Ranges { vec2 ranges[]; };
uniform int count, rough;

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= uint(count)) return;
  ranges[i] = depthRange(Area(areas[i].xy, areas[i].zw), rough != 0);
}
