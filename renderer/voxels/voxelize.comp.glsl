// SPDX-License-Identifier: BSD-3-Clause
// Triangles into voxels: an invocation sets up a triangle, and lists its columns if they are few; the group shares what it has
// listed. Larger ones are queued in parts for voxelize_queued.comp.glsl.
#include "renderer/voxels/voxel_columns.glsl"

uniform uint firstTriangle, triangleCount;  // up to triangleCount

shared vec3 corners[3 * kVoxelizeGroup];
shared uint listed;
shared uint list[kVoxelizeAlone * kVoxelizeGroup];  // lane and column

// Columns for which the queue has no place; from x up to y.
ivec2 enqueue(uint id, int count) {
  const uint parts = uint(count + kVoxelizePart - 1) / uint(kVoxelizePart), at = atomicAdd(queue.queued[queueTurn], parts);
  const uint free = min(queueCapacity - min(queueCapacity, at), parts);
  for (uint i = 0u; i < free; ++i) queueParts[at + i] = uvec2(id, uint(kVoxelizePart) * i);
  return ivec2(kVoxelizePart * int(free), count);
}

void main() {
  const uint lane = gl_LocalInvocationIndex;
  const uint base = firstTriangle + uint(kVoxelizeGroup) * (gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y);
  if (lane == 0u) listed = 0u;
  barrier();
  VoxelTriangle t;
  ivec2 own = ivec2(0);
  if (base + lane < triangleCount && loadTriangle(base + lane, t)) {
    const int count = workCount(workOf(t));
    if (count > kVoxelizeAlone)
      own = enqueue(base + lane, count);
    else if (count > 0) {
      corners[3u * lane] = t.a;
      corners[3u * lane + 1u] = t.b;
      corners[3u * lane + 2u] = t.c;
      const uint at = atomicAdd(listed, uint(count));
      for (uint i = 0u; i < uint(count); ++i) list[at + i] = lane << 16 | i;
    }
  }
  barrier();
  // Its own columns first, while it has the triangle, then those listed: one call, as the compiler copies functions to where they
  // are called, and NVIDIA's takes seconds for each copy.
  uint i = lane;
  while (own.x < own.y || i < listed) {
    uint from = lane;
    int column = own.x;
    if (own.x < own.y) {
      ++own.x;
    } else {
      from = list[i] >> 16;
      column = int(list[i] & 0xffffu);
      i += uint(kVoxelizeGroup);
      setUp(t, corners[3u * from], corners[3u * from + 1u], corners[3u * from + 2u]);
    }
    takeColumn(t, base + from, workOf(t), column);
  }
  reportRays();
}
