// SPDX-License-Identifier: BSD-3-Clause
// How many slices each triangle has.
#include "renderer/techniques/voxelization/slice_list.glsl"

layout(std430, binding = kSliceCountsBuffer) writeonly buffer Counts { uint sliceCounts[]; };
uniform uint triangleCount;

void main() {
  const uint id = uint(kSliceGroup) * (gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y) + gl_LocalInvocationIndex;
  if (id >= triangleCount) return;
  VoxelTriangle t;
  sliceCounts[id] = loadTriangle(id, t) ? uint(slicesOf(t, axisOf(t)).y) : 0u;
}
