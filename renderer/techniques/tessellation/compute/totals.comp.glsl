// SPDX-License-Identifier: BSD-3-Clause
// How many patches fit into the buffers, how many invocations share a patch (unless VERTEX_PARALLEL), and what is
// drawn. One group. See compute.cpp.
#include "renderer/frame/frame_bindings.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

layout(local_size_x = kTessellationGroup) in;
layout(std430, binding = kSlotOffsetsBuffer) readonly buffer SlotOffsets { uvec2 slotOffsets[]; };
layout(std430, binding = kTotalsBuffer) writeonly buffer Totals { TessellationTotals totals; };

layout(std430, binding = kTriangleCountBuffer) writeonly buffer Count { RasterCount listed_; };

uniform uint patchCount, vertexCapacity, indexCapacity;
uniform uint indicesPerSlot;        // 3 if the second offsets count triangles
uniform uint lanes, indexLanes;     // 0: as many as suit the patches
uniform uint manyInvocations;       // that occupy a GPU
uniform uint verticesPerInvocation; // where there are many

shared uint sampledPatches[kTessellationGroup];

// Logarithm of the number of invocations for each patch: the wanted number of items each, or fewer items where there would
// be few invocations in all, but no fewer than one. `seen`: patches that are not culled.
uint lanesFor(uint items, float seen) {
  const float each = float(items) / seen;
  const float wanted = max(each / float(verticesPerInvocation), min(each, float(manyInvocations) / seen));
  return uint(floor(log2(clamp(wanted, float(kLeastLanes), float(kMostLanes))) + 0.5));
}

void main() {
  const uint local = gl_LocalInvocationIndex;
  // Share of patches that are not culled, from samples.
  const uint place = uint((float(local) + 0.5) / float(kTessellationGroup) * float(patchCount));
  sampledPatches[local] = place < patchCount && slotOffsets[place + 1u].x > slotOffsets[place].x ? 1u : 0u;
  barrier();
  if (local > 0u) return;
  uint samples = 0u;
  for (int i = 0; i < kTessellationGroup; ++i) samples += sampledPatches[i];
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
#ifdef VERTEX_PARALLEL
  const uint laneBits = 0u, indexLaneBits = 0u;
#else
  const float seen = max(float(low) * float(max(samples, 1u)) / float(kTessellationGroup), 1.0);
  const uint laneBits = lanes > 0u ? uint(findMSB(lanes)) : lanesFor(used.x, seen),
             indexLaneBits = indexLanes > 0u ? uint(findMSB(indexLanes)) : lanesFor(used.y, seen);
#endif
  totals.vertices = used.x;
  totals.patches = low;
  totals.indices = used.y * indicesPerSlot;
  totals.instances = 1u;
  totals.firstIndex = 0u;
  totals.baseVertex = 0u;
  totals.baseInstance = 0u;
  totals.laneBits = laneBits;
  totals.indexLaneBits = indexLaneBits;
  listed_.triangles = used.y * indicesPerSlot / 3u;  // as ComputeRaster takes them
  totals.overflow = patchCount - low;
  totals.neededVertices = needed.x;
  totals.neededIndices = needed.y > 0xffffffffu / indicesPerSlot ? 0xffffffffu : needed.y * indicesPerSlot;
}
