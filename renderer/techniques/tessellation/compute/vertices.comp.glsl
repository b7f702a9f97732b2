// SPDX-License-Identifier: BSD-3-Clause
// Phase 4: vertices. A group for each patch (PATCH_PARALLEL) or an invocation for each vertex. See compute.cpp.
#include "renderer/techniques/tessellation/compute/slots.glsl"

layout(std430, binding = kVerticesBuffer) writeonly buffer Vertices { TessellatedVertex vertices[]; };

void main() {
  const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
#ifdef PATCH_PARALLEL
  if (group >= totals.patches) return;
  const uint first = slotOffsets[group].x, count = slotOffsets[group + 1u].x - first;
  if (count == 0u) return;
  const TessellatedPatch patch_ = patches[group];
  const PatternPlan plan = planOf(group, shapeOf(patch_));
  for (uint slot = gl_LocalInvocationIndex; slot < count; slot += uint(kTessellationGroup))
    vertices[first + slot] = surfaceVertex(patch_, domainPoint(shapeOf(patch_), patternSample(plan, int(slot))));
#else
  const uint firstSlot = group * uint(kTessellationGroup), slot = firstSlot + gl_LocalInvocationIndex;
  if (firstSlot >= totals.vertices) return;
  const uint number = patchOfSlot(firstSlot, totals.vertices, 0);
  if (slot >= totals.vertices) return;
  const TessellatedPatch patch_ = patches[number];
  const PatternPlan plan = planOf(number, shapeOf(patch_));
  const ivec4 place = patternSample(plan, int(slot - slotOffsets[number].x));
  vertices[slot] = surfaceVertex(patch_, domainPoint(shapeOf(patch_), place));
#endif
}
