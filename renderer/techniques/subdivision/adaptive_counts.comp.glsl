// SPDX-License-Identifier: BSD-3-Clause
// Vertices and triangles of each patch at the largest of its sides' levels.
#include "renderer/techniques/subdivision/tables.glsl"

layout(local_size_x = kSubdivisionGroup) in;
layout(std430, binding = kEdgeLevelsBuffer) readonly buffer EdgeLevels { float edgeLevels[]; };
layout(std430, binding = kPatchCountsBuffer) writeonly buffer Counts { uvec2 counts[]; };
uniform uint patchCount;

void main() {
  const uint number = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (number >= patchCount || gl_LocalInvocationIndex != 0u) return;
  float level = 0.0;
  for (int s = 0; s < CORNERS; ++s) level = max(level, edgeLevels[patches[number].edges[s]]);
  const uint n = 1u << uint(ceil(level));
#if CORNERS == 3
  counts[number] = uvec2((n + 1u) * (n + 2u) / 2u, n * n);
#else
  counts[number] = uvec2((n + 1u) * (n + 1u), 2u * n * n);
#endif
}
