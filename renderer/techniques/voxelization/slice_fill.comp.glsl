// SPDX-License-Identifier: BSD-3-Clause
// A slice of a triangle an invocation, found by a search in the prefix sum of the numbers of slices. The group shares
// slices of many columns. Groups take one run of items after another.
#include "renderer/techniques/voxelization/slice_list.glsl"

layout(std430, binding = kSliceSumsBuffer) readonly buffer Sums { uint sliceSums[]; };
layout(binding = kVoxelBitsImage, r32ui) uniform uimage2DArray bitsImage;
uniform uint triangleCount;

// The last triangle whose items begin at `item` or before.
uint triangleOf(uint item) {
  uint low = 0u, high = triangleCount;
  while (high - low > 1u) {
    const uint middle = (low + high) / 2u;
    if (sliceSums[middle] <= item)
      low = middle;
    else
      high = middle;
  }
  return low;
}

void fillColumn(VoxelTriangle t, int axis, int slice, Columns columns, int index) {
  const ivec2 column = columns.first + ivec2(index % columns.count.x, index / columns.count.x);
  float place;
  if (placeMet(t, column, axis, place) != slice) return;
  const ivec3 voxel = voxelOf(column, slice, axis), texel = ivec3(voxel.x >> 5, voxel.yz);
  const uint bit = 1u << (voxel.x & 31);
  if ((imageLoad(bitsImage, texel).x & bit) == 0u) imageAtomicOr(bitsImage, texel, bit);
}

shared uvec2 wide[kSliceGroup];  // triangle and slice
shared uint wideCount;

void main() {
  const uint total = sliceSums[triangleCount], lane = gl_LocalInvocationIndex, step_ = uint(kSliceGroup) * gl_NumWorkGroups.x;
  for (uint base = uint(kSliceGroup) * gl_WorkGroupID.x; base < total; base += step_) {
    if (lane == 0u) wideCount = 0u;
    barrier();
    if (base + lane < total) {
      const uint id = triangleOf(base + lane);
      VoxelTriangle t;
      loadTriangle(id, t);
      const int axis = axisOf(t), slice = slicesOf(t, axis).x + int(base + lane - sliceSums[id]);
      const Columns columns = columnsOfSlice(t, axis, slice);
      const int count = columnCount(columns);
      if (count > kSliceAlone)
        wide[atomicAdd(wideCount, 1u)] = uvec2(id, slice);
      else
        for (int i = 0; i < count; ++i) fillColumn(t, axis, slice, columns, i);
    }
    barrier();
    for (uint k = 0u; k < wideCount; ++k) {
      VoxelTriangle t;
      loadTriangle(wide[k].x, t);
      const int axis = axisOf(t), slice = int(wide[k].y);
      const Columns columns = columnsOfSlice(t, axis, slice);
      const int count = columnCount(columns);
      for (int i = int(lane); i < count; i += kSliceGroup) fillColumn(t, axis, slice, columns, i);
    }
    barrier();
  }
}
