// SPDX-License-Identifier: BSD-3-Clause
// Phase 5: indices of triangle strips. A group for each patch (PATCH_PARALLEL) or an invocation for each index.
// See compute.cpp.
#include "renderer/techniques/tessellation/compute/slots.glsl"

layout(std430, binding = kIndicesBuffer) writeonly buffer Indices { uint indices[]; };

uint indexAt(PatternPlan plan, int slot, uint firstVertex) {
  const int vertex = patternIndex(plan, slot);
  return vertex == kPatternRestart ? 0xffffffffu : firstVertex + uint(vertex);
}

void main() {
  const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
#ifdef PATCH_PARALLEL
  if (group >= totals.patches) return;
  const uvec2 first = slotOffsets[group];
  const uint count = slotOffsets[group + 1u].y - first.y;
  if (count == 0u) return;
  const PatternPlan plan = planOf(group, shapeOf(patches[group]));
  for (uint slot = gl_LocalInvocationIndex; slot < count; slot += uint(kTessellationGroup))
    indices[first.y + slot] = indexAt(plan, int(slot), first.x);
#else
  const uint firstSlot = group * uint(kTessellationGroup), slot = firstSlot + gl_LocalInvocationIndex;
  if (firstSlot >= totals.indices) return;
  const uint number = patchOfSlot(firstSlot, totals.indices, 1);
  if (slot >= totals.indices) return;
  const uvec2 first = slotOffsets[number];
  indices[slot] = indexAt(planOf(number, shapeOf(patches[number])), int(slot - first.y), first.x);
#endif
}
