// SPDX-License-Identifier: BSD-3-Clause
// Phase 4: vertices. A group for each patch (PATCH_PARALLEL), or an invocation for each vertex (VERTEX_PARALLEL). RESTART: by
// forward differences that start anew after so many samples. See compute.cpp.
#include "renderer/techniques/tessellation/compute/pattern_vertices.glsl"

layout(std430, binding = kVerticesBuffer) writeonly buffer Vertices { TessellatedVertex vertices[]; };

#ifdef RESTART
#define DIFFERENCE vec4
#include "renderer/techniques/tessellation/compute/difference_rows.glsl"

// Samples of the core's rows in runs; those of the strips one by one.
void differences(TessellatedPatch patch_, uint number, PatternPlan plan, uint first) {
  const int width = plan.cols + 1, runs = (width + RESTART - 1) / RESTART;
  const int items = (plan.rows + 1) * runs;
  for (int item = int(gl_LocalInvocationIndex); item < items; item += kTessellationGroup) {
    const int row = item / runs, begin = (item - row * runs) * RESTART, end = min(begin + RESTART, width);
    const DifferenceRow curve = differenceRow(patch_, gridFraction(plan.low.y + row, plan.mv),
                                              gridFraction(plan.mv - plan.low.y - row, plan.mv));
    DifferenceRuns state = differenceRuns(curve, plan.low.x + begin, plan.mu);
    for (int at = begin; at < end; ++at) {
      const int slot = row * width + at;
      const ivec4 s = patternSample(plan, slot);
      if (isDirect(s)) {
        vertices[first + uint(slot)] = patternVertex(patch_, number, plan, slot);
      } else {
        const SurfaceJet jet = SurfaceJet(state.value.value, state.along.value, state.across.value);
        vertices[first + uint(slot)] = vertexOf(patch_, domainPoint(shapeOf(patch_), s), jet);
      }
      advance(state);
    }
  }
  for (int slot = plan.coreVertices + int(gl_LocalInvocationIndex); slot < plan.vertices; slot += kTessellationGroup)
    vertices[first + uint(slot)] = patternVertex(patch_, number, plan, slot);
}
#endif

void main() {
  const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
#ifdef VERTEX_PARALLEL
  const uint firstSlot = group * uint(kTessellationGroup), slot = firstSlot + gl_LocalInvocationIndex;
  if (firstSlot >= totals.vertices) return;
  const uint number = patchOfSlot(firstSlot, totals.vertices, 0);
  if (slot >= totals.vertices) return;
  const TessellatedPatch patch_ = patches[number];
  const PatternPlan plan = planOf(number, shapeOf(patch_));
  vertices[slot] = patternVertex(patch_, number, plan, int(slot - slotOffsets[number].x));
#else
  if (group >= totals.patches) return;
  const uint first = slotOffsets[group].x, count = slotOffsets[group + 1u].x - first;
  if (count == 0u) return;
  const TessellatedPatch patch_ = patches[group];
  const PatternPlan plan = planOf(group, shapeOf(patch_));
#ifdef RESTART
  if (isRectangle(shapeOf(patch_)) && degreeU(shapeOf(patch_)) == 3) {
    differences(patch_, group, plan, first);
    return;
  }
#endif
  for (uint slot = gl_LocalInvocationIndex; slot < count; slot += uint(kTessellationGroup))
    vertices[first + slot] = patternVertex(patch_, group, plan, int(slot));
#endif
}
