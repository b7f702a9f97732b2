// SPDX-License-Identifier: BSD-3-Clause
// Phase 4 where the vertex shader evaluates (SC-76): of each vertex its patch and its sample. See compute.cpp.
#include "renderer/techniques/tessellation/compute/slots.glsl"

layout(std430, binding = kVerticesBuffer) writeonly buffer Instances { uvec2 instances[]; };

void writeInstance(PatternPlan plan, uint number, uint first, uint slot) {
  instances[first + slot] = uvec2(number, packedSegments(patternSample(plan, int(slot))));
}

#ifdef VERTEX_PARALLEL
void main() {
  for (uint firstSlot = gl_WorkGroupID.x * uint(kTessellationGroup); firstSlot < totals.vertices;
       firstSlot += invocationCount()) {
    const uint slot = firstSlot + gl_LocalInvocationIndex, number = patchOfSlot(firstSlot, totals.vertices, 0);
    if (slot >= totals.vertices) continue;
    const uint first = slotOffsets[number].x;
    writeInstance(planOf(number, shapeOf(patches[number])), number, first, slot - first);
  }
}
#else
void writeInstances(PatchLane by) {
  const uint first = slotOffsets[by.number].x, count = slotOffsets[by.number + 1u].x - first;
  if (count == 0u) return;
  const PatternPlan plan = planOf(by.number, shapeOf(patches[by.number]));
  for (uint slot = by.lane; slot < count; slot += by.lanes) writeInstance(plan, by.number, first, slot);
}

void main() {
  const uint count = totals.patches << totals.laneBits;
  for (uint i = gl_GlobalInvocationID.x; i < count; i += invocationCount()) writeInstances(patchLane(i, totals.laneBits));
}
#endif
