// SPDX-License-Identifier: BSD-3-Clause
// Parts of large triangles that voxelize.comp.glsl has queued: a group takes one after another.
#include "renderer/voxels/voxel_columns.glsl"

void main() {
  const uint parts = min(queue.queued[queueTurn], queueCapacity);
  if (gl_GlobalInvocationID.x == 0u) queue.queued[1 - queueTurn] = 0u;
  for (uint part = gl_WorkGroupID.x; part < parts; part += gl_NumWorkGroups.x) {
    const uvec2 taken = queueParts[part];
    VoxelTriangle t;
    loadTriangle(taken.x, t);
    const Work work = workOf(t);
    const int first = int(taken.y), last = min(workCount(work), first + kVoxelizePart);
    for (int i = first + int(gl_LocalInvocationIndex); i < last; i += kVoxelizeGroup) takeColumn(t, taken.x, work, i);
  }
  reportRays();
}
