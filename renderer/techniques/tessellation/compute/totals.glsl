// SPDX-License-Identifier: BSD-3-Clause
// How many patches fit into the buffers, how many invocations share a patch (unless VERTEX_PARALLEL), and what is drawn. The
// including shader declares patchCount. See compute.cpp.
#include "renderer/frame/frame_bindings.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

layout(std430, binding = kTotalsBuffer) writeonly buffer Totals { TessellationTotals totals; };

layout(std430, binding = kTriangleCountBuffer) writeonly buffer Count { RasterCount listed_; };

uniform uint vertexCapacity, indexCapacity;
uniform uint indicesPerSlot;        // 3 if the second offsets count triangles
uniform uint lanes, indexLanes;     // 0: as many as suit the patches
uniform uint manyInvocations;       // that occupy a GPU
uniform uint verticesPerInvocation; // where there are many

// Logarithm of the number of invocations for each patch: the wanted number of items each, or fewer items where there would
// be few invocations in all, but no fewer than one. `seen`: patches that are not culled.
uint lanesFor(uint items, float seen) {
  const float each = float(items) / seen;
  const float wanted = max(each / float(verticesPerInvocation), min(each, float(manyInvocations) / seen));
  return uint(floor(log2(clamp(wanted, float(kLeastLanes), float(kMostLanes))) + 0.5));
}

// Whether patches whose slots end there fit. Offsets never fall, and those that have overflowed are larger than any buffer.
bool fits(uvec2 end) { return end.x <= vertexCapacity && end.y <= indexCapacity / indicesPerSlot; }

// `low`: patches that fit, with the slots `used` of all that are `needed`; `share`: of patches that are not culled.
void writeTotals(uint low, uvec2 used, uvec2 needed, float share) {
#ifdef VERTEX_PARALLEL
  const uint laneBits = 0u, indexLaneBits = 0u;
#else
  const float seen = max(float(low) * share, 1.0);
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
