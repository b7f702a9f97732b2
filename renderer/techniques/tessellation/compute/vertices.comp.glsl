// SPDX-License-Identifier: BSD-3-Clause
// Phase 4: vertices. A group for each patch (PATCH_PARALLEL), or an invocation for each vertex (VERTEX_PARALLEL). RESTART: by
// forward differences that start anew after so many samples. See compute.cpp.
#include "renderer/techniques/tessellation/compute/pattern_vertices.glsl"

layout(std430, binding = kVerticesBuffer) writeonly buffer Vertices { TessellatedVertex vertices[]; };

#ifdef RESTART
#define DIFFERENCE BicubicPoint
#include "renderer/techniques/tessellation/compute/difference_rows.glsl"

// Samples of the core's rows in runs.
void core(TessellatedPatch patch_, uint number, PatternPlan plan, uint first) {
  const int width = plan.cols + 1, runs = (width + RESTART - 1) / RESTART;
  const int items = (plan.rows + 1) * runs;
  patchFirst = int(patch_.firstPoint);
  for (int item = int(gl_LocalInvocationIndex); item < items; item += kTessellationGroup) {
    const int row = item / runs, begin = (item - row * runs) * RESTART, end = min(begin + RESTART, width);
    const int j = plan.low.y + row;
    DifferenceRuns state = differenceRuns(differenceRow(gridFraction(j, plan.mv), gridFraction(plan.mv - j, plan.mv)),
                                          plan.low.x + begin, plan.mu);
    for (int at = begin; at < end; ++at) {
      const ivec4 s = ivec4(plan.low.x + at, plan.mu, j, plan.mv);
      const vec4 point = domainPoint(shapeOf(patch_), s);
      BezierJet jet;
      if (isDirect(s)) {
        jet = bezierBicubic(point);
      } else {
        jet.p = homogeneousPoint(state.value.value);
        jet.u = homogeneousDerivative(state.along.value);
        jet.v = homogeneousDerivative(state.across.value);
      }
      vertices[first + uint(row * width + at)] = vertexOf(patch_, point, jet);
      advance(state);
    }
  }
}
#elif !defined(VERTEX_PARALLEL) && SPACING < 2
// Samples of the core's columns in runs, which share the curve at their u. Neighbouring invocations write neighbouring
// vertices. As many runs as take the fewest steps, one for a sample and one and a half for a curve.
void core(TessellatedPatch patch_, uint number, PatternPlan plan, uint first) {
  const int width = plan.cols + 1, height = plan.rows + 1;
  int runs = 1, fewest = 1 << 30;
  for (int candidate = 1; candidate <= min(height, 8); ++candidate) {
    const int steps = ((width * candidate + kTessellationGroup - 1) / kTessellationGroup) *
                      (3 + 2 * ((height + candidate - 1) / candidate));
    if (steps < fewest) {
      fewest = steps;
      runs = candidate;
    }
  }
  const int length_ = (height + runs - 1) / runs;
  patchFirst = int(patch_.firstPoint);
  for (int item = int(gl_LocalInvocationIndex); item < width * runs; item += kTessellationGroup) {
    const int run = item / width, column = item - run * width, i = plan.low.x + column;
    const float u = gridFraction(i, plan.mu), rest = gridFraction(plan.mu - i, plan.mu);
    const BicubicColumn curve = bicubicColumn(u, rest);
    const int end = min((run + 1) * length_, height);
    for (int row = run * length_; row < end; ++row) {
      const int j = plan.low.y + row;
      const vec4 at = vec4(u, gridFraction(j, plan.mv), rest, gridFraction(plan.mv - j, plan.mv));
      vertices[first + uint(row * width + column)] = vertexOf(patch_, at, bicubicAt(curve, at.y, at.w));
    }
  }
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
  uint begin = gl_LocalInvocationIndex;
#if defined(RESTART) || SPACING < 2
  if (isBicubic(shapeOf(patch_))) {
    core(patch_, group, plan, first);
    begin += uint(plan.coreVertices);
  }
#endif
  for (uint slot = begin; slot < count; slot += uint(kTessellationGroup))
    vertices[first + slot] = patternVertex(patch_, group, plan, int(slot));
#endif
}
