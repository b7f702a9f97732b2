// SPDX-License-Identifier: BSD-3-Clause
// Phase 4 as in Schwarz 2009, section 7.6.2 (SC-71): four invocations a patch, one for each homogeneous component. Each
// evaluates its component of four samples; then each of them finishes one sample (there, three finish every sample
// together). Bicubic patches; others get whole vertices from each invocation. RESTART: as in vertices.comp.glsl.
#include "renderer/techniques/tessellation/compute/pattern_vertices.glsl"
#include "renderer/techniques/tessellation/store_vertex.glsl"

const int kPatchesPerGroup = kTessellationGroup / 4;
shared float jets[kPatchesPerGroup * 4 * 12];  // of each patch and sample: p, u, v
shared int mostRounds;

#define DIFFERENCE float
#define LANE (gl_LocalInvocationIndex & 3u)
#include "renderer/techniques/tessellation/compute/difference_rows.glsl"

// In the order of cubicSum() and quadraticSum(), so that sides are bitwise the same.
float cubic(float a, float b, float c, float d, vec4 basis) {
  precise const float outer = a * basis.x + d * basis.w, inner = b * basis.y + c * basis.z, sum = outer + inner;
  return sum;
}
float quadratic(float a, float b, float c, vec3 basis) {
  precise const float outer = a * basis.x + c * basis.z, sum = outer + b * basis.y;
  return sum;
}

// Of one component: value, derivatives along u and v.
vec3 componentAt(vec4 at) {
  precise const vec4 bu = cubicBasis(at.x, at.z), bv = cubicBasis(at.y, at.w);
  precise const vec3 du = quadraticBasis(at.x, at.z), dv = quadraticBasis(at.y, at.w);
  precise float p[4], u[4];
  for (int j = 0; j < 4; ++j) {
    const float a = controlPoint(4 * j), b = controlPoint(4 * j + 1), c = controlPoint(4 * j + 2), d = controlPoint(4 * j + 3);
    p[j] = cubic(a, b, c, d, bu);
    u[j] = 3.0 * quadratic(b - a, c - b, d - c, du);
  }
  return vec3(cubic(p[0], p[1], p[2], p[3], bv), cubic(u[0], u[1], u[2], u[3], bv),
              3.0 * quadratic(p[1] - p[0], p[2] - p[1], p[3] - p[2], dv));
}

void main() {
  const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  const int local = int(gl_LocalInvocationIndex), lane = local & 3, place = local / 4;
  const uint number = group * uint(kPatchesPerGroup) + uint(place);
  if (local == 0) mostRounds = 0;
  barrier();
  const bool there = number < totals.patches;
  uint first = 0u;
  int count = 0;
  if (there) {
    first = slotOffsets[number].x;
    count = int(slotOffsets[number + 1u].x - first);
  }
  atomicMax(mostRounds, (count + 3) / 4);
  barrier();
  const TessellatedPatch patch_ = patches[there ? number : 0u];
  const uint shape = shapeOf(patch_);
  const bool bicubic = isBicubic(shape);
  patchFirst = int(patch_.firstPoint);
  PatternPlan plan;
  if (count > 0) plan = planOf(number, shape);
#ifdef RESTART
  DifferenceRow row;
  DifferenceRuns runs;
#endif
  const int rounds = mostRounds;
  for (int round_ = 0; round_ < rounds; ++round_) {
    for (int k = 0; k < 4; ++k) {
      const int slot = 4 * round_ + k;
      if (slot >= count || !bicubic) continue;
      const ivec4 s = patternSample(plan, slot);
      vec3 jet;
#ifdef RESTART
      const int width = plan.cols + 1, at = slot % width;
      if (slot < plan.coreVertices) {
        if (at == 0)
          row = differenceRow(gridFraction(s.z, s.w), gridFraction(s.w - s.z, s.w));
        if (at % RESTART == 0) {
          runs = differenceRuns(row, s.x, plan.mu);
        } else {
          advance(runs);
        }
      }
      if (slot < plan.coreVertices && !isDirect(s)) {
        jet = vec3(runs.value.value, runs.along.value, runs.across.value);
      } else {
        jet = componentAt(domainPoint(shape, s));
      }
#else
      jet = componentAt(domainPoint(shape, s));
#endif
      for (int part = 0; part < 3; ++part) jets[(place * 4 + k) * 12 + part * 4 + lane] = jet[part];
    }
    barrier();
    const int mine = 4 * round_ + lane;
    if (mine < count) {
      if (bicubic) {
        BezierJet jet;
        const int from = (place * 4 + lane) * 12;
        jet.p = vec4(jets[from], jets[from + 1], jets[from + 2], jets[from + 3]);
        jet.u = vec4(jets[from + 4], jets[from + 5], jets[from + 6], jets[from + 7]);
        jet.v = vec4(jets[from + 8], jets[from + 9], jets[from + 10], jets[from + 11]);
        storeVertex(first + uint(mine), vertexOf(patch_, domainPoint(shape, patternSample(plan, mine)), jet));
      } else {
        storeVertex(first + uint(mine), patternVertex(patch_, number, plan, mine));
      }
    }
    barrier();
  }
}
