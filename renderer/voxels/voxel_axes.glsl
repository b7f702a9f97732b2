// SPDX-License-Identifier: BSD-3-Clause
// Axes of a grid: the one that a triangle is assigned to, and what lies across one.
#include "renderer/voxels/voxel_bindings.h"

// Whether one component of a triangle's normal is as large as another, but for rounding: that of a ratio of components is a
// vertex's by how far the triangle reaches along the two axes. More must not pass for equal: along an axis that a triangle faces less
// than another its columns are more than a voxel apart, and it has holes.
bool isAsLarge(vec3 size, vec3 extent, int axis, int other) {
  return size[axis] >= (1.0 - kVoxelSlack / clamp(max(extent[axis], extent[other]), 1.0, 1024.0)) * size[other];
}

// Axis that a triangle is assigned to: of its normal's largest component, and of equal ones the first, so that neither the place
// nor the size of a world decides. One without area: the last.
int axisOfTriangle(vec3 a, vec3 b, vec3 c) {
  const vec3 size = abs(cross(b - a, c - a)), extent = max(a, max(b, c)) - min(a, min(b, c));
  if (!(max(size.x, max(size.y, size.z)) > 0.0)) return 2;
  if (isAsLarge(size, extent, 0, 1) && isAsLarge(size, extent, 0, 2)) return 0;
  return isAsLarge(size, extent, 1, 2) ? 1 : 2;
}

ivec2 acrossAxis(int axis) { return ivec2((axis + 1) % 3, (axis + 2) % 3); }

vec2 across(vec3 v, int axis) { return axis == 0 ? v.yz : axis == 1 ? v.zx : v.xy; }
ivec2 across(ivec3 v, int axis) { return axis == 0 ? v.yz : axis == 1 ? v.zx : v.xy; }
