// SPDX-License-Identifier: BSD-3-Clause
// Phase 5: indices of triangle strips, or of single triangles (LISTS: a slot is then a triangle). A group for each patch
// or an invocation for each slot (VERTEX_PARALLEL). See compute.cpp.
#include "renderer/techniques/tessellation/compute/slots.glsl"

layout(std430, binding = kIndicesBuffer) writeonly buffer Indices { uint indices[]; };

#ifdef LISTS
const uint kIndicesPerSlot = 3u;
#else
const uint kIndicesPerSlot = 1u;
#endif

// `first`: first vertex and first slot of the patch.
void writeSlot(PatternPlan plan, uint slot, uvec2 first) {
#ifdef LISTS
  const uvec3 corners = uvec3(patternTriangle(plan, int(slot))) + first.x;
  const uint at = 3u * (first.y + slot);
  indices[at] = corners.x;
  indices[at + 1u] = corners.y;
  indices[at + 2u] = corners.z;
#else
  const int vertex = patternIndex(plan, int(slot));
  indices[first.y + slot] = vertex == kPatternRestart ? 0xffffffffu : first.x + uint(vertex);
#endif
}

void main() {
  const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
#ifndef VERTEX_PARALLEL
  if (group >= totals.patches) return;
  const uvec2 first = slotOffsets[group];
  const uint count = slotOffsets[group + 1u].y - first.y;
  if (count == 0u) return;
  const PatternPlan plan = planOf(group, shapeOf(patches[group]));
  for (uint slot = gl_LocalInvocationIndex; slot < count; slot += uint(kTessellationGroup))
    writeSlot(plan, slot, first);
#else
  const uint slots = totals.indices / kIndicesPerSlot;
  const uint firstSlot = group * uint(kTessellationGroup), slot = firstSlot + gl_LocalInvocationIndex;
  if (firstSlot >= slots) return;
  const uint number = patchOfSlot(firstSlot, slots, 1);
  if (slot >= slots) return;
  const uvec2 first = slotOffsets[number];
  writeSlot(planOf(number, shapeOf(patches[number])), slot - first.y, first);
#endif
}
