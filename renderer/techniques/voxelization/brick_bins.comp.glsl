// SPDX-License-Identifier: BSD-3-Clause
// Which bricks each triangle may meet: their numbers of triangles are counted, or (SCATTER) counted down again while each
// brick's part of a list is filled. An invocation has a triangle; the group shares those of many bricks.
#include "renderer/techniques/voxelization/voxelization_bindings.h"
#include "renderer/voxels/voxel_triangle.glsl"

layout(local_size_x = kBrickGroup) in;
layout(std430, binding = kBrickCountsBuffer) buffer Counts { uint brickCounts[]; };
#ifdef SCATTER
layout(std430, binding = kBrickStartsBuffer) readonly buffer Starts { uint brickStarts[]; };
layout(std430, binding = kBrickTrianglesBuffer) writeonly buffer Listed { uint brickTriangles[]; };
uniform uint listCapacity;
#endif
uniform uint triangleCount;

const ivec3 kBrick = ivec3(kBrickX, kBrickY, kBrickZ);

struct Bricks {
  ivec3 first, count;
};
Bricks bricksOf(VoxelTriangle t) {
  const ivec3 most = gridSize() - 1;
  Bricks bricks;
  bricks.first = clamp(ivec3(floor(t.low - kVoxelSlack)), ivec3(0), most) / kBrick;
  bricks.count = clamp(ivec3(floor(t.high + kVoxelSlack)), ivec3(0), most) / kBrick - bricks.first + 1;
  return bricks;
}
int brickCount(Bricks bricks) { return bricks.count.x * bricks.count.y * bricks.count.z; }

void enter(VoxelTriangle t, uint id, Bricks bricks, int index) {
  const int row = index / bricks.count.x;
  const ivec3 brick = bricks.first + ivec3(index % bricks.count.x, row % bricks.count.y, row / bricks.count.y);
  // Whether its plane meets the brick, grown by rounding.
  const vec3 half_ = 0.5 * vec3(kBrick) + 4.0 * kVoxelSlack, middle = (vec3(brick) + 0.5) * vec3(kBrick);
  if (abs(dot(t.normal, middle - t.a)) > 1.001 * dot(abs(t.normal), half_)) return;
  const ivec3 all_ = (gridSize() + kBrick - 1) / kBrick;
  const uint at = uint(brick.x + all_.x * (brick.y + all_.y * brick.z));
#ifdef SCATTER
  const uint place = brickStarts[at] + atomicAdd(brickCounts[at], 0xffffffffu) - 1u;
  if (place < listCapacity) brickTriangles[place] = id;
#else
  atomicAdd(brickCounts[at], 1u);
#endif
}

shared uint wide[kBrickGroup];
shared uint wideCount;

void main() {
  const uint lane = gl_LocalInvocationIndex;
  const uint id = uint(kBrickGroup) * (gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y) + lane;
  if (lane == 0u) wideCount = 0u;
  barrier();
  VoxelTriangle t;
  if (id < triangleCount && loadTriangle(id, t)) {
    const Bricks bricks = bricksOf(t);
    const int count = brickCount(bricks);
    if (count > kBrickAlone)
      wide[atomicAdd(wideCount, 1u)] = id;
    else
      for (int i = 0; i < count; ++i) enter(t, id, bricks, i);
  }
  barrier();
  for (uint k = 0u; k < wideCount; ++k) {
    loadTriangle(wide[k], t);
    const Bricks bricks = bricksOf(t);
    const int count = brickCount(bricks);
    for (int i = int(lane); i < count; i += kBrickGroup) enter(t, wide[k], bricks, i);
  }
}
