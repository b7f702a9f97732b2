// SPDX-License-Identifier: BSD-3-Clause
// Which patch a slot belongs to, and the pattern of a patch.
#include "renderer/techniques/tessellation/evaluate.glsl"

layout(local_size_x = kTessellationGroup) in;
layout(std430, binding = kFactorsBuffer) readonly buffer Factors { PatchFactors factors[]; };
layout(std430, binding = kSlotOffsetsBuffer) readonly buffer SlotOffsets { uvec2 slotOffsets[]; };
layout(std430, binding = kTotalsBuffer) readonly buffer Totals { TessellationTotals totals; };

uniform int cornerFix;

PatternPlan planOf(uint number, uint shape) {
  const ivec4 mine = unpackedSegments(factors[number].segments);
  if (isRectangle(shape)) return rectanglePattern(mine, cornerFix);
  return trianglePattern(mine, cornerFix);
}

ivec4 unitsOf(uint number) { return unpackedUnits(uvec2(factors[number].first, factors[number].second)); }

// Last of the patches [low, high] whose slots begin at `slot` or before it. `lane`: 0 vertices, 1 indices.
uint patchAt(uint slot, int lane, uint low, uint high) {
  while (low < high) {
    const uint middle = (low + high + 1u) / 2u;
    if (slotOffsets[middle][lane] <= slot) {
      low = middle;
    } else {
      high = middle - 1u;
    }
  }
  return low;
}

// Of the invocations that share a patch.
struct PatchLane {
  uint number, lane, lanes;
};

PatchLane patchLane(uint invocation, uint laneBits) {
  const uint lanes = 1u << laneBits;
  return PatchLane(invocation >> laneBits, invocation & (lanes - 1u), lanes);
}

// A fixed number of groups takes one piece of work after another; only the GPU knows how much there is.
uint invocationCount() { return gl_NumWorkGroups.x * uint(kTessellationGroup); }

#ifdef VERTEX_PARALLEL
shared uint groupPatches[2];

// Of this invocation's slot; the group's first and last slot bound the search. Called by the whole group.
uint patchOfSlot(uint firstSlot, uint slotCount, int lane) {
  barrier();  // the search before is done
  if (gl_LocalInvocationIndex < 2u) {
    const uint last = min(firstSlot + uint(kTessellationGroup), slotCount) - 1u;
    groupPatches[gl_LocalInvocationIndex] =
        patchAt(gl_LocalInvocationIndex == 0u ? firstSlot : last, lane, 0u, totals.patches - 1u);
  }
  barrier();
  return patchAt(min(firstSlot + gl_LocalInvocationIndex, slotCount - 1u), lane, groupPatches[0], groupPatches[1]);
}
#endif
