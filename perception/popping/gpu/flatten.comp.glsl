// SPDX-License-Identifier: BSD-3-Clause
// Hangs every pixel right below its root and tells the root of the seeds of its tiles.
#include "perception/popping/gpu/region_table.glsl"

layout(local_size_x = kRegionGroup) in;

uniform uint pixelCount;

void main() {
  uint pixel = gl_WorkGroupID.y * (gl_NumWorkGroups.x * uint(kRegionGroup)) + gl_GlobalInvocationID.x;
  if (pixel >= pixelCount) return;
  uint root = parents[pixel];
  if (root == kNone) return;
  for (uint parent = parents[root]; parent != root; parent = parents[root]) root = parent;
  parents[pixel] = root;
  if (root != pixel && roots[pixel] == 1u && roots[root] == 0u) atomicOr(roots[root], 1u);
}
