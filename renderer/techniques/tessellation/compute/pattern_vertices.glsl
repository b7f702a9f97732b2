// SPDX-License-Identifier: BSD-3-Clause
// Vertex of a pattern's slot. SPACING: as spacing.h numbers them.
#include "renderer/techniques/tessellation/compute/slots.glsl"

#if SPACING == 5
// What geomorphing needs of a vertex.
struct MorphPoint {
  vec3 position, normal;
  uint rung;
};

// Two vertices' middle, the same bit by bit whichever comes first.
MorphPoint middleOf(MorphPoint a, MorphPoint b) {
  precise const vec3 position = (a.position + b.position) * 0.5;
  return MorphPoint(position, 0.5 * (a.normal + b.normal), max(a.rung, b.rung));
}

MorphPoint mixed(MorphPoint coarse, MorphPoint fine, float share) {
  precise const vec3 position = coarse.position + (fine.position - coarse.position) * share;
  return MorphPoint(position, mix(coarse.normal, fine.normal, share), fine.rung);
}

// Vertices that the level of half as many segments lacks move from where it has the middle of an edge to their own
// place (SC-74). An edge of that level runs as the strips' diagonals do.
TessellatedVertex geomorphed(TessellatedPatch patch_, ivec4 s, ivec4 units) {
  const uint shape = shapeOf(patch_);
  const bool rectangle = isRectangle(shape);
  const int side = sideOfSample(rectangle ? 1 : 0, s);
  // Edges of the coarser level whose middles count, by the steps from this vertex to their ends. Of a rectangle, one along
  // u, one along v, or these and a diagonal.
  ivec4 step0 = ivec4(0), step1 = ivec4(0), step2 = ivec4(0);
  int edges = 0;
  float share0 = 1.0, share1 = 1.0;
  if (rectangle) {
    const bool oddU = (s.x & 1) == 1 && s.x < s.y, oddV = (s.z & 1) == 1 && s.z < s.w;
    const float shareU = morphShare(unitsAlong(units, side, 0), s.y), shareV = morphShare(unitsAlong(units, side, 1), s.w);
    edges = oddU && oddV ? 3 : (oddU || oddV ? 1 : 0);
    step0 = oddU ? ivec4(1, 0, 0, 0) : ivec4(0, 0, 1, 0);
    step1 = ivec4(0, 0, 1, 0);
    step2 = ivec4(1, 0, 1, 0);
    share0 = oddU ? shareU : shareV;
    share1 = shareV;
  } else {
    const bvec3 odd = bvec3((s.x & 1) == 1, (s.y & 1) == 1, (s.z & 1) == 1);
    edges = s.w > 1 && any(odd) ? 1 : 0;
    step0 = !odd.x ? ivec4(0, 1, -1, 0) : (!odd.y ? ivec4(1, 0, -1, 0) : ivec4(1, -1, 0, 0));
    const int most = max(units.x, max(units.y, units.z));
    share0 = morphShare(side < 0 ? most : units[side], s.w);
  }
  // In one loop, so that the surface's evaluation is compiled once.
  TessellatedVertex fine = TessellatedVertex(vec3(0.0), 0u, vec3(0.0), 0u);
  MorphPoint end = MorphPoint(vec3(0.0), vec3(0.0), 0u), middle0 = end, middle1 = end, middle2 = end;
  for (int k = 0; k <= 2 * edges; ++k) {
    const int edge = (k - 1) / 2;
    const ivec4 step_ = k == 0 ? ivec4(0) : (edge == 0 ? step0 : (edge == 1 ? step1 : step2));
    const TessellatedVertex vertex = surfaceVertex(patch_, domainPoint(shape, (k & 1) == 1 ? s - step_ : s + step_));
    const MorphPoint point = MorphPoint(vertex.position, vertex.normal, vertex.rung);
    if (k == 0) {
      fine = vertex;
    } else if ((k & 1) == 1) {
      end = point;
    } else if (edge == 0) {
      middle0 = middleOf(end, point);
    } else if (edge == 1) {
      middle1 = middleOf(end, point);
    } else {
      middle2 = middleOf(end, point);
    }
  }
  if (edges == 0) return fine;
  const MorphPoint own = MorphPoint(fine.position, fine.normal, fine.rung);
  MorphPoint out_ = mixed(middle0, own, share0);
  if (edges == 3) out_ = mixed(mixed(middle2, middle1, share0), out_, share1);
  const vec3 normal = dot(out_.normal, out_.normal) > 0.0 ? normalize(out_.normal) : fine.normal;
  return TessellatedVertex(out_.position, fine.material, normal, out_.rung);
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
