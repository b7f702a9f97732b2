// SPDX-License-Identifier: BSD-3-Clause
// Phase 4 where the vertex shader evaluates (SC-76): of each vertex its patch and its sample. See compute.cpp.
#include "renderer/techniques/tessellation/compute/slots.glsl"

layout(std430, binding = kVerticesBuffer) writeonly buffer Instances { uvec2 instances[]; };

void writeInstance(PatternPlan plan, uint number, uint first, uint slot) {
  instances[first + slot] = uvec2(number, packedSegments(patternSample(plan, int(slot))));
}

void main() {
#ifdef VERTEX_PARALLEL
  const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  const uint firstSlot = group * uint(kTessellationGroup), slot = firstSlot + gl_LocalInvocationIndex;
  if (firstSlot >= totals.vertices) return;
  const uint number = patchOfSlot(firstSlot, totals.vertices, 0);
  if (slot >= totals.vertices) return;
  const uint first = slotOffsets[number].x;
  writeInstance(planOf(number, shapeOf(patches[number])), number, first, slot - first);
#else
  const PatchLane by = patchLane(totals.laneBits);
  if (by.number >= totals.patches) return;
  const uint first = slotOffsets[by.number].x, count = slotOffsets[by.number + 1u].x - first;
  if (count == 0u) return;
  const PatternPlan plan = planOf(by.number, shapeOf(patches[by.number]));
  for (uint slot = by.lane; slot < count; slot += by.lanes) writeInstance(plan, by.number, first, slot);
#endif
}
