// SPDX-License-Identifier: BSD-3-Clause
// How many patches fit into the buffers, and what is dispatched and drawn for them. One invocation. See compute.cpp.
#include "renderer/frame/frame_bindings.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

layout(local_size_x = 1) in;
layout(std430, binding = kSlotOffsetsBuffer) readonly buffer SlotOffsets { uvec2 slotOffsets[]; };
layout(std430, binding = kTotalsBuffer) writeonly buffer Totals { TessellationTotals totals; };

layout(std430, binding = kTriangleCountBuffer) writeonly buffer Count { RasterCount listed_; };

uniform uint patchCount, vertexCapacity, indexCapacity;
uniform uint indicesPerSlot;  // 3 if the second offsets count triangles

uvec2 groupsFor(uint items) {
  const uint groups = (items + uint(kTessellationGroup) - 1u) / uint(kTessellationGroup);
  const uint rows = (groups + 65534u) / 65535u;
  return rows == 0u ? uvec2(0u) : uvec2((groups + rows - 1u) / rows, rows);
}

void main() {
  // Offsets never fall, and those that have overflowed are larger than any buffer.
  uint low = 0u, high = patchCount;
  while (low < high) {
    const uint middle = (low + high + 1u) / 2u;
    const uvec2 end = slotOffsets[middle];
    if (end.x <= vertexCapacity && end.y <= indexCapacity / indicesPerSlot) {
      low = middle;
    } else {
      high = middle - 1u;
    }
  }
  const uvec2 used = slotOffsets[low], needed = slotOffsets[patchCount];
  const uvec2 vertexGroups = groupsFor(used.x), indexGroups = groupsFor(used.y);
  totals.groupsX = vertexGroups.x;
  totals.groupsY = vertexGroups.y;
  totals.groupsZ = 1u;
  totals.indexGroupsX = indexGroups.x;
  totals.indexGroupsY = indexGroups.y;
  totals.indexGroupsZ = 1u;
  totals.vertices = used.x;
  totals.patches = low;
  totals.indices = used.y * indicesPerSlot;
  totals.instances = 1u;
  totals.firstIndex = 0u;
  totals.baseVertex = 0u;
  totals.baseInstance = 0u;
  // As ComputeRaster takes lists of triangles.
  const uint triangles = used.y * indicesPerSlot / 3u;
  listed_.groupsX = (min(triangles, kRasterRowInvocations) + uint(kRasterGroup) - 1u) / uint(kRasterGroup);
  listed_.groupsY = (triangles + kRasterRowInvocations - 1u) / kRasterRowInvocations;
  listed_.groupsZ = 1u;
  listed_.triangles = triangles;
  totals.overflow = patchCount - low;
  totals.neededVertices = needed.x;
  totals.neededIndices = needed.y > 0xffffffffu / indicesPerSlot ? 0xffffffffu : needed.y * indicesPerSlot;
}
