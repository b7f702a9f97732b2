// SPDX-License-Identifier: BSD-3-Clause
// Where a geometry shader sends a point of a triangle that it assigns to AXIS.
#include "renderer/techniques/voxelization/seen_along.glsl"

layout(triangles) in;
layout(location = 0) in vec3 place[];
layout(location = 1) flat in uint firstTriangle[];
#if defined(SUMS) && !defined(CONSERVATIVE)
layout(location = 2) out vec3 point;  // in voxels
#endif
#if defined(SUMS) || defined(CONSERVATIVE)
layout(location = 3) flat out uint triangle;
#endif

// What a fragment's attributes are made from.
void carry(vec3 at) {
#if defined(SUMS) && !defined(CONSERVATIVE)
  point = at;
  triangle = firstTriangle[0] + uint(gl_PrimitiveIDIn);
#endif
}

bool isAssigned() { return axisOfTriangle(place[0], place[1], place[2]) == AXIS; }

// First and last of the slices that the triangle reaches, if it is assigned to AXIS; otherwise the last is before the first.
// `slack`: voxels by which it is taken to reach farther.
ivec2 slicesReached(float slack) {
  if (!isAssigned()) return ivec2(0, -1);
  const float low = min(place[0][AXIS], min(place[1][AXIS], place[2][AXIS]));
  const float high = max(place[0][AXIS], max(place[1][AXIS], place[2][AXIS]));
  const int size = gridSize()[AXIS];
  if (!(high >= -kVoxelSlack && low <= float(size) + kVoxelSlack)) return ivec2(0, -1);
  return clamp(ivec2(floor(vec2(low - slack, high + slack))), 0, size - 1);
}
