// SPDX-License-Identifier: BSD-3-Clause
// A brick a group: the columns that its triangles have in it, along all three axes, into bits in shared memory, which are
// stored whole. Nothing is cleared before, and no bit in global memory is changed twice.
#include "renderer/techniques/voxelization/voxelization_bindings.h"
#include "renderer/voxels/voxel_triangle.glsl"

layout(local_size_x = kBrickGroup) in;
layout(std430, binding = kBrickStartsBuffer) readonly buffer Starts { uint brickStarts[]; };
layout(std430, binding = kBrickTrianglesBuffer) readonly buffer Listed { uint brickTriangles[]; };
layout(binding = kVoxelBitsImage, r32ui) uniform writeonly uimage2DArray bitsImage;
uniform uint listCapacity;

const ivec3 kBrick = ivec3(kBrickX, kBrickY, kBrickZ);

shared uint words[kBrickY * kBrickZ];
shared uint wide[kBrickGroup];
shared uint wideCount;
ivec3 low = ivec3(0);  // the brick's first voxel

// Columns of the triangle within the brick.
Columns columnsHere(VoxelTriangle t, int axis) {
  Columns columns = columnsOf(t, axis, true);
  const ivec2 from = across(low, axis), to = from + across(kBrick, axis);
  const ivec2 last = min(columns.first + columns.count, to);
  columns.first = max(columns.first, from);
  columns.count = max(last - columns.first, ivec2(0));
  return columns;
}

void fillColumn(VoxelTriangle t, int axis, Columns columns, int index) {
  const ivec2 column = columns.first + ivec2(index % columns.count.x, index / columns.count.x);
  float place;
  const int at = placeMet(t, column, axis, place);
  const ivec3 voxel = voxelOf(column, at, axis) - low;
  if (at < 0 || any(lessThan(voxel, ivec3(0))) || any(greaterThanEqual(voxel, kBrick))) return;
  atomicOr(words[voxel.y + kBrickY * voxel.z], 1u << voxel.x);
}

void main() {
  const uint lane = gl_LocalInvocationIndex;
  const ivec3 all_ = (gridSize() + kBrick - 1) / kBrick;
  const uint brick = gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y;
  if (brick >= uint(all_.x * all_.y * all_.z)) return;
  const int row = int(brick) / all_.x;
  low = kBrick * ivec3(int(brick) % all_.x, row % all_.y, row / all_.y);
  words[lane] = 0u;
  const uint first = min(brickStarts[brick], listCapacity), last = min(brickStarts[brick + 1u], listCapacity);
  for (uint base = first; base < last; base += uint(kBrickGroup)) {
    if (lane == 0u) wideCount = 0u;
    barrier();
    if (base + lane < last) {
      const uint id = brickTriangles[base + lane];
      VoxelTriangle t;
      loadTriangle(id, t);
      int count = 0;
      for (int axis = 0; axis < 3; ++axis) count += columnCount(columnsHere(t, axis));
      if (count > kBrickAlone)
        wide[atomicAdd(wideCount, 1u)] = id;
      else if (count > 0)
        for (int axis = 0; axis < 3; ++axis) {
          const Columns columns = columnsHere(t, axis);
          const int here = columnCount(columns);
          for (int i = 0; i < here; ++i) fillColumn(t, axis, columns, i);
        }
    }
    barrier();
    for (uint k = 0u; k < wideCount; ++k) {
      VoxelTriangle t;
      loadTriangle(wide[k], t);
      for (int axis = 0; axis < 3; ++axis) {
        const Columns columns = columnsHere(t, axis);
        const int here = columnCount(columns);
        for (int i = int(lane); i < here; i += kBrickGroup) fillColumn(t, axis, columns, i);
      }
    }
    barrier();
  }
  barrier();
  const ivec3 texel = ivec3(low.x >> 5, low.y + int(lane) % kBrickY, low.z + int(lane) / kBrickY);
  if (texel.y < gridSizeY && texel.z < gridSizeZ) imageStore(bitsImage, texel, uvec4(words[lane]));
}
