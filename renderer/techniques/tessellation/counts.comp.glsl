// SPDX-License-Identifier: BSD-3-Clause
// Phase 2: of a common side the larger factor; vertices and indices of each patch. See factor_pass.h.
#include "renderer/surfaces/pattern_slots.h"
#include "renderer/techniques/tessellation/patches.glsl"

layout(local_size_x = kTessellationGroup) in;
layout(std430, binding = kOwnFactorsBuffer) readonly buffer OwnFactors { uint ownFactors[]; };
layout(std430, binding = kFactorsBuffer) writeonly buffer Factors { uint factors[]; };
layout(std430, binding = kSlotCountsBuffer) writeonly buffer SlotCounts { uvec2 slotCounts[]; };

uniform uint patchCount;
uniform int cornerFix;

void main() {
  const uint number = gl_GlobalInvocationID.x;
  if (number >= patchCount) return;
  const uint own = ownFactors[number];
  if (own == 0u) {
    factors[number] = 0u;
    slotCounts[number] = uvec2(0u);
    return;
  }
  const TessellatedPatch patch_ = patches[number];
  ivec4 mine = unpackedFactors(own);
  for (int side = 0; side < 4; ++side) {
    const int neighbour = patch_.neighbours[side];
    if (neighbour >= 0) mine[side] = max(mine[side], int(ownFactors[neighbour / 4] >> (neighbour % 4 * 8) & 255u));
  }
  factors[number] = packedFactors(mine);
  PatternPlan plan;
  if (isRectangle(shapeOf(patch_))) {
    plan = rectanglePattern(mine, cornerFix);
  } else {
    plan = trianglePattern(mine, cornerFix);
  }
#ifdef LISTS
  slotCounts[number] = uvec2(plan.vertices, plan.triangles);
#else
  slotCounts[number] = uvec2(plan.vertices, plan.indices);
#endif
}
