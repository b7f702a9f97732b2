// SPDX-License-Identifier: BSD-3-Clause
// Phase 4: vertices. Some invocations for each patch, or one for each vertex (VERTEX_PARALLEL). RESTART: by forward
// differences that start anew after so many samples. See compute.cpp.
#include "renderer/techniques/tessellation/compute/pattern_vertices.glsl"
#include "renderer/techniques/tessellation/store_vertex.glsl"

#ifdef RESTART
#define DIFFERENCE BicubicPoint
#include "renderer/techniques/tessellation/compute/difference_rows.glsl"

// Samples of the core's rows in runs.
void core(TessellatedPatch patch_, PatternPlan plan, uint first, PatchLane by) {
  const int width = plan.cols + 1, runs = (width + RESTART - 1) / RESTART;
  const int items = (plan.rows + 1) * runs;
  patchFirst = int(patch_.firstPoint);
  for (int item = int(by.lane); item < items; item += int(by.lanes)) {
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
      storeVertex(first + uint(row * width + at), vertexOf(patch_, point, jet));
      advance(state);
    }
  }
}
#elif !defined(VERTEX_PARALLEL) && SPACING < 2
// Into how many runs columns are cut: as many as take the fewest steps, two for a sample and three for a curve, of those
// that leave few invocations idle in their last round.
int runsOf(int width, int height, int lanes) {
  if (width * height <= lanes) return height;
  const int leastRounds = (width + lanes - 1) / lanes;
  int runs = 1, fewest = 1 << 30;
  for (int rounds = leastRounds; rounds < leastRounds + 4; ++rounds) {
    const int candidate = min(rounds * lanes / width, height);
    const int steps = rounds * (3 + 2 * ((height + candidate - 1) / candidate));
    if (steps < fewest) {
      fewest = steps;
      runs = candidate;
    }
  }
  return runs;
}

// Samples of the core's columns in runs, which share the curve at their u. Neighbouring invocations write neighbouring
// vertices.
void core(TessellatedPatch patch_, PatternPlan plan, uint first, PatchLane by) {
  const int width = plan.cols + 1, height = plan.rows + 1, runs = runsOf(width, height, int(by.lanes));
  const int length_ = (height + runs - 1) / runs;
  patchFirst = int(patch_.firstPoint);
  for (int item = int(by.lane); item < width * runs; item += int(by.lanes)) {
    const int run = item / width, column = item - run * width, i = plan.low.x + column;
    const float u = gridFraction(i, plan.mu), rest = gridFraction(plan.mu - i, plan.mu);
    const BicubicColumn curve = bicubicColumn(u, rest);
    const int end = min((run + 1) * length_, height);
    for (int row = run * length_; row < end; ++row) {
      const int j = plan.low.y + row;
      const vec4 at = vec4(u, gridFraction(j, plan.mv), rest, gridFraction(plan.mv - j, plan.mv));
      storeVertex(first + uint(row * width + column), vertexOf(patch_, at, bicubicAt(curve, at.y, at.w)));
    }
  }
}
#endif

#ifdef VERTEX_PARALLEL
void main() {
  for (uint firstSlot = gl_WorkGroupID.x * uint(kTessellationGroup); firstSlot < totals.vertices;
       firstSlot += invocationCount()) {
    const uint slot = firstSlot + gl_LocalInvocationIndex, number = patchOfSlot(firstSlot, totals.vertices, 0);
    if (slot >= totals.vertices) continue;
    const TessellatedPatch patch_ = patches[number];
    const PatternPlan plan = planOf(number, shapeOf(patch_));
    storeVertex(slot, patternVertex(patch_, number, plan, int(slot - slotOffsets[number].x)));
  }
}
#else
void makeVertices(PatchLane by) {
  const uint first = slotOffsets[by.number].x, count = slotOffsets[by.number + 1u].x - first;
  if (count == 0u) return;
  const TessellatedPatch patch_ = patches[by.number];
  const PatternPlan plan = planOf(by.number, shapeOf(patch_));
  uint begin = by.lane;
#if defined(RESTART) || SPACING < 2
  if (isBicubic(shapeOf(patch_))) {
    core(patch_, plan, first, by);
    begin += uint(plan.coreVertices);
  }
#endif
  for (uint slot = begin; slot < count; slot += by.lanes)
    storeVertex(first + slot, patternVertex(patch_, by.number, plan, int(slot)));
}

void main() {
  const uint count = totals.patches << totals.laneBits;
  for (uint i = gl_GlobalInvocationID.x; i < count; i += invocationCount()) makeVertices(patchLane(i, totals.laneBits));
}
#endif
