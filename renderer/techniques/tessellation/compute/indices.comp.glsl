// SPDX-License-Identifier: BSD-3-Clause
// Phase 5: indices of triangle strips, or of single triangles (LISTS: a slot is then a triangle). Some invocations for each
// patch, or one for each slot (VERTEX_PARALLEL). See compute.cpp.
#include "renderer/techniques/tessellation/compute/slots.glsl"

layout(std430, binding = kIndicesBuffer) writeonly buffer Indices { uint indices[]; };

#ifdef LISTS
const uint kIndicesPerSlot = 3u;
#ifdef VERTEX_PARALLEL
layout(std430, binding = kIndicesBuffer) writeonly buffer IndexWords { uvec4 indexWords[]; };
#endif
#else
const uint kIndicesPerSlot = 1u;
#endif

uint stripIndex(PatternPlan plan, uint slot, uint firstVertex) {
  const int vertex = patternIndex(plan, int(slot));
  return vertex == kPatternRestart ? 0xffffffffu : firstVertex + uint(vertex);
}

#ifdef VERTEX_PARALLEL
#ifdef LISTS
shared uint groupIndices[3 * kTessellationGroup];
#endif

void main() {
  const uint local = gl_LocalInvocationIndex, slots = totals.indices / kIndicesPerSlot;
  for (uint firstSlot = gl_WorkGroupID.x * uint(kTessellationGroup); firstSlot < slots; firstSlot += invocationCount()) {
    const uint slot = firstSlot + local, number = patchOfSlot(firstSlot, slots, 1);
    const uvec2 first = slotOffsets[number];
    const PatternPlan plan = planOf(number, shapeOf(patches[number]));
#ifdef LISTS
    const uvec3 corners =
        slot < slots ? uvec3(patternTriangle(plan, int(slot - first.y))) + first.x : uvec3(0u);
    groupIndices[3u * local] = corners.x;
    groupIndices[3u * local + 1u] = corners.y;
    groupIndices[3u * local + 2u] = corners.z;
    barrier();
    // The buffer's length is a multiple of four words.
    const uint place = firstSlot / 4u * 3u + local;
    if (local < uint(3 * kTessellationGroup / 4) && 4u * place < totals.indices)
      indexWords[place] = uvec4(groupIndices[4u * local], groupIndices[4u * local + 1u], groupIndices[4u * local + 2u],
                                groupIndices[4u * local + 3u]);
    barrier();
#else
    if (slot < slots) indices[slot] = stripIndex(plan, slot - first.y, first.x);
#endif
  }
}
#else
void makeIndices(PatchLane at) {
  const uvec2 first = slotOffsets[at.number];
  const uint count = slotOffsets[at.number + 1u].y - first.y;
  if (count == 0u) return;
  const PatternPlan plan = planOf(at.number, shapeOf(patches[at.number]));
#ifdef LISTS
  // Three stores: a triangle's corners cost more than what they waste.
  for (uint slot = at.lane; slot < count; slot += at.lanes) {
    const uvec3 corners = uvec3(patternTriangle(plan, int(slot))) + first.x;
    const uint place = 3u * (first.y + slot);
    indices[place] = corners.x;
    indices[place + 1u] = corners.y;
    indices[place + 2u] = corners.z;
  }
#else
  for (uint slot = at.lane; slot < count; slot += at.lanes)
    indices[first.y + slot] = stripIndex(plan, slot, first.x);
#endif
}

void main() {
  const uint count = totals.patches << totals.indexLaneBits;
  for (uint i = gl_GlobalInvocationID.x; i < count; i += invocationCount()) makeIndices(patchLane(i, totals.indexLaneBits));
}
#endif
