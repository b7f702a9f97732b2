// SPDX-License-Identifier: BSD-3-Clause
// A triangle's slices along the axis of its normal's largest component, and which columns of a slice it may fill.
#include "renderer/techniques/voxelization/voxelization_bindings.h"
#include "renderer/voxels/voxel_triangle.glsl"

layout(local_size_x = kSliceGroup) in;
uniform int mostSlices;  // of a triangle

int axisOf(VoxelTriangle t) { return axisOfTriangle(t.a, t.b, t.c); }

// First slice and number of slices.
ivec2 slicesOf(VoxelTriangle t, int axis) {
  const int size = gridSize()[axis];
  const int first = clamp(int(floor(t.low[axis])), 0, size - 1), last = clamp(int(floor(t.high[axis])), 0, size - 1);
  return ivec2(first, min(last - first + 1, mostSlices));
}

// Columns around the part of the triangle between a slice's planes, these moved apart by more than rounding.
Columns columnsOfSlice(VoxelTriangle t, int axis, int slice) {
  const float from = float(slice) - 2.0 * kVoxelSlack, to = float(slice + 1) + 2.0 * kVoxelSlack;
  const bool first = slice == 0, last = slice == gridSize()[axis] - 1;
  const vec3 corners[3] = vec3[3](t.a, t.b, t.c);
  VoxelTriangle part = t;
  part.low = vec3(1e30);
  part.high = vec3(-1e30);
  for (int i = 0; i < 3; ++i) {
    const vec3 p = corners[i], q = corners[(i + 1) % 3];
    if ((first || p[axis] >= from) && (last || p[axis] <= to)) {
      part.low = min(part.low, p);
      part.high = max(part.high, p);
    }
    for (int side = 0; side < 2; ++side) {
      const float plane = side == 0 ? from : to, before = p[axis] - plane, after = q[axis] - plane;
      if ((before < 0.0) == (after < 0.0)) continue;
      const vec3 at = mix(p, q, clamp(before / (before - after), 0.0, 1.0));
      part.low = min(part.low, at);
      part.high = max(part.high, at);
    }
  }
  return columnsOf(part, axis, true);
}
