// SPDX-License-Identifier: BSD-3-Clause
// Vertex of a pattern's slot. SPACING: as spacing.h numbers them.
#include "renderer/techniques/tessellation/compute/slots.glsl"

#if SPACING == 5
// Two vertices' middle, the same bit by bit whichever comes first.
TessellatedVertex middleOf(TessellatedVertex a, TessellatedVertex b) {
  precise const vec3 position = (a.position + b.position) * 0.5;
  a.position = position;
  a.normal = 0.5 * (a.normal + b.normal);
  a.rung = max(a.rung, b.rung);
  return a;
}

TessellatedVertex mixed(TessellatedVertex coarse, TessellatedVertex fine, float share) {
  precise const vec3 position = coarse.position + (fine.position - coarse.position) * share;
  fine.position = position;
  fine.normal = mix(coarse.normal, fine.normal, share);
  return fine;
}

TessellatedVertex vertexAt(TessellatedPatch patch_, ivec4 s) {
  return surfaceVertex(patch_, domainPoint(shapeOf(patch_), s));
}
TessellatedVertex middleAt(TessellatedPatch patch_, ivec4 s, ivec4 step_) {
  return middleOf(vertexAt(patch_, s - step_), vertexAt(patch_, s + step_));
}

// Vertices that the level of half as many segments lacks move from where it has the middle of an edge to their own
// place (SC-74). An edge of that level runs as the strips' diagonals do.
TessellatedVertex geomorphed(TessellatedPatch patch_, ivec4 s, ivec4 units) {
  const TessellatedVertex fine = vertexAt(patch_, s);
  const bool rectangle = isRectangle(shapeOf(patch_));
  const int side = sideOfSample(rectangle ? 1 : 0, s);
  TessellatedVertex out_ = fine;
  if (rectangle) {
    const bool oddU = (s.x & 1) == 1 && s.x < s.y, oddV = (s.z & 1) == 1 && s.z < s.w;
    const float shareU = morphShare(unitsAlong(units, side, 0), s.y), shareV = morphShare(unitsAlong(units, side, 1), s.w);
    const ivec4 alongU = ivec4(1, 0, 0, 0), alongV = ivec4(0, 0, 1, 0);
    if (oddU && oddV) {
      const TessellatedVertex both = middleAt(patch_, s, alongU + alongV);
      out_ = mixed(mixed(both, middleAt(patch_, s, alongV), shareU), mixed(middleAt(patch_, s, alongU), fine, shareU),
                   shareV);
    } else if (oddU) {
      out_ = mixed(middleAt(patch_, s, alongU), fine, shareU);
    } else if (oddV) {
      out_ = mixed(middleAt(patch_, s, alongV), fine, shareV);
    }
  } else {
    const bvec3 odd = bvec3((s.x & 1) == 1, (s.y & 1) == 1, (s.z & 1) == 1);
    if (s.w > 1 && any(odd)) {
      const ivec4 step_ = !odd.x ? ivec4(0, 1, -1, 0) : (!odd.y ? ivec4(1, 0, -1, 0) : ivec4(1, -1, 0, 0));
      const int most = max(units.x, max(units.y, units.z));
      out_ = mixed(middleAt(patch_, s, step_), fine, morphShare(side < 0 ? most : units[side], s.w));
    }
  }
  out_.normal = dot(out_.normal, out_.normal) > 0.0 ? normalize(out_.normal) : fine.normal;
  return out_;
}
#endif

TessellatedVertex patternVertex(TessellatedPatch patch_, uint number, PatternPlan plan, int slot) {
  const uint shape = shapeOf(patch_);
  if (plan.triangles == 1 && normalDegree(shape) > 0) return triangleCorner(patch_, slot);
  const ivec4 s = patternSample(plan, slot);
#if SPACING == 5
  return geomorphed(patch_, s, unitsOf(number));
#elif SPACING >= 2
  return surfaceVertex(patch_, spacedPoint(shape, s, SPACING, unitsOf(number)));
#else
  return surfaceVertex(patch_, domainPoint(shape, s));
#endif
}
