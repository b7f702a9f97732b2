// SPDX-License-Identifier: BSD-3-Clause
// Triangles of fragments, a group each, at the fragment's level. Those with two corners in one place are listed as well.
#include "renderer/techniques/subdivision/fragments/fragment_bindings.h"
#include "renderer/techniques/subdivision/subdivision_bindings.h"
#define CORNERS 4
#include "renderer/techniques/subdivision/grid_triangles.glsl"

layout(local_size_x = kFragmentGroup) in;
layout(std430, binding = kFragmentLevelsBuffer) readonly buffer Levels { uint levels[]; };
layout(std430, binding = kFragmentOffsetsBuffer) readonly buffer Offsets { uvec2 offsets[]; };
layout(std430, binding = kFragmentIndicesBuffer) writeonly buffer Indices { uint indices[]; };
layout(std430, binding = kFragmentTotalsBuffer) writeonly buffer Totals { AdaptiveTotals totals; };
uniform uint fragmentCount;

void main() {
  const uint number = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (number >= fragmentCount) return;
  const uvec2 first = offsets[number], next = offsets[number + 1u];
  if (number + 1u == fragmentCount && gl_LocalInvocationIndex == 0u)
    totals = AdaptiveTotals(next.y, next.x, 0u, 0u, 3u * next.y, 1u, 0u, 0u, 0u, 0u, 0u, 0u);
  const int segments = 1 << (levels[number] & 15u);
  for (uint t = gl_LocalInvocationIndex; t < next.y - first.y; t += uint(kFragmentGroup)) {
    const ivec2[3] corners = gridTriangle(t, segments);
    for (int c = 0; c < 3; ++c)
      indices[3u * (first.y + t) + uint(c)] = first.x + uint(corners[c].x + (segments + 1) * corners[c].y);
  }
}
