// SPDX-License-Identifier: BSD-3-Clause
// Of a patch's common sides the larger factor, and how many vertices and indices its pattern takes. See factor_pass.h.
#include "renderer/surfaces/spacing.h"
#include "renderer/techniques/tessellation/patches.glsl"

layout(std430, binding = kOwnFactorsBuffer) readonly buffer OwnFactors { uvec2 ownFactors[]; };
layout(std430, binding = kFactorsBuffer) writeonly buffer Factors { PatchFactors factors[]; };

uniform uint patchCount;
uniform int cornerFix;

// Writes the factors.
uvec2 patchCounts(uint number) {
  const uvec2 own = ownFactors[number];
  if (own == uvec2(0u)) {
    factors[number] = PatchFactors(0u, 0u, 0u, 0u);
    return uvec2(0u);
  }
  const TessellatedPatch patch_ = patches[number];
  ivec4 units = unpackedUnits(own);
  for (int side = 0; side < 4; ++side) {
    const int neighbour = patch_.neighbours[side];
    if (neighbour >= 0) units[side] = max(units[side], unpackedUnits(ownFactors[neighbour / 8])[neighbour / 2 % 4]);
  }
  ivec4 mine;
  for (int side = 0; side < 4; ++side) mine[side] = spacedSegments(SPACING, units[side]);
  const uvec2 packed_ = packedUnits(units);
  factors[number] = PatchFactors(packedSegments(mine), packed_.x, packed_.y, 0u);
  PatternPlan plan;
  if (isRectangle(shapeOf(patch_))) {
    plan = rectanglePattern(mine, cornerFix);
  } else {
    plan = trianglePattern(mine, cornerFix);
  }
#ifdef LISTS
  return uvec2(plan.vertices, plan.triangles);
#else
  return uvec2(plan.vertices, plan.indices);
#endif
}
