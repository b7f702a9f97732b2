// SPDX-License-Identifier: BSD-3-Clause
// Triangles of patches of different levels, a group a patch. Those with two corners in one place are listed as well.
#include "renderer/techniques/subdivision/tables.glsl"

layout(local_size_x = kSubdivisionGroup) in;
layout(std430, binding = kPatchOffsetsBuffer) readonly buffer Offsets { uvec2 offsets[]; };
layout(std430, binding = kFineIndicesBuffer) writeonly buffer FineIndices { uint fineIndices[]; };
layout(std430, binding = kAdaptiveTotalsBuffer) writeonly buffer Totals { AdaptiveTotals totals; };
uniform uint patchCount;

#include "renderer/techniques/subdivision/grid_triangles.glsl"

void main() {
  const uint number = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (number >= patchCount) return;
  const uvec2 first = offsets[number], next = offsets[number + 1u];
  if (number + 1u == patchCount && gl_LocalInvocationIndex == 0u)
    totals = AdaptiveTotals(next.y, next.x, 0u, 0u, 3u * next.y, 1u, 0u, 0u, 0u, 0u, 0u, 0u);
  const uint count = next.y - first.y;
#if CORNERS == 3
  const int segments = int(round(sqrt(float(count))));
#else
  const int segments = int(round(sqrt(float(count / 2u))));
#endif
  const int step = TABLE_SEGMENTS / segments;
  for (uint t = gl_LocalInvocationIndex; t < count; t += uint(kSubdivisionGroup)) {
    const ivec2[3] corners = gridTriangle(t, segments);
    for (int c = 0; c < 3; ++c) fineIndices[3u * (first.y + t) + uint(c)] = first.x + rowOfPlace(corners[c] * step);
  }
}
