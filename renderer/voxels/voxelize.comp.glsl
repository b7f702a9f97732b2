// SPDX-License-Identifier: BSD-3-Clause
// Triangles into voxels: an invocation sets up a triangle, and lists its columns if they are few; the group shares what it has
// listed. Larger ones are queued in parts for voxelize_queued.comp.glsl.
#include "renderer/voxels/voxel_columns.glsl"

uniform uint firstTriangle, triangleCount;  // up to triangleCount

shared vec3 corners[3 * kVoxelizeGroup];
shared uint listed;
shared uint list[kVoxelizeAlone * kVoxelizeGroup];  // lane and column

void enqueue(VoxelTriangle t, uint id, int count) {
  const uint parts = uint(count + kVoxelizePart - 1) / uint(kVoxelizePart), at = atomicAdd(queue.queued[queueTurn], parts);
  for (uint i = 0u; i < parts; ++i) {
    if (at + i < queueCapacity) {
      queueParts[at + i] = uvec2(id, uint(kVoxelizePart) * i);
      continue;
    }
    // The queue is full.
    const Work work = workOf(t);
    const int from = kVoxelizePart * int(i), to = min(count, from + kVoxelizePart);
    for (int column = from; column < to; ++column) takeColumn(t, id, work, column);
  }
}

void main() {
  const uint lane = gl_LocalInvocationIndex;
  const uint base = firstTriangle + uint(kVoxelizeGroup) * (gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y);
  if (lane == 0u) listed = 0u;
  barrier();
  VoxelTriangle t;
  if (base + lane < triangleCount && loadTriangle(base + lane, t)) {
    const int count = workCount(workOf(t));
    if (count > kVoxelizeAlone)
      enqueue(t, base + lane, count);
    else if (count > 0) {
      corners[3u * lane] = t.a;
      corners[3u * lane + 1u] = t.b;
      corners[3u * lane + 2u] = t.c;
      const uint at = atomicAdd(listed, uint(count));
      for (uint i = 0u; i < uint(count); ++i) list[at + i] = lane << 16 | i;
    }
  }
  barrier();
  for (uint i = lane; i < listed; i += uint(kVoxelizeGroup)) {
    const uint from = list[i] >> 16;
    setUp(t, corners[3u * from], corners[3u * from + 1u], corners[3u * from + 2u]);
    takeColumn(t, base + from, workOf(t), int(list[i] & 0xffffu));
  }
  reportRays();
}
