// SPDX-License-Identifier: BSD-3-Clause
// Post-process (SC-74): of two patches along a side the later one gets the earlier one's positions, whatever evaluated them.
// An invocation for each side. Corners, of which both are evaluated directly, are left as they are.
#include "renderer/techniques/tessellation/compute/slots.glsl"

// As store_vertex.glsl writes them: the first of two words is the position and the material.
layout(std430, binding = kVerticesBuffer) buffer VertexWords { uvec4 vertexWords[]; };

void main() {
  const uint item = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(kTessellationGroup) + gl_LocalInvocationIndex;
  const uint number = item / 4u;
  const int side = int(item & 3u);
  if (number >= totals.patches) return;
  const TessellatedPatch patch_ = patches[number];
  const int neighbour = patch_.neighbours[side];
  if (neighbour < 0 || neighbour / 2 >= int(item)) return;
  const uint other = uint(neighbour / 8);
  const int otherSide = neighbour / 2 % 4;
  if (factors[number].segments == 0u || factors[other].segments == 0u) return;
  const PatternPlan mine = planOf(number, shapeOf(patch_)), theirs = planOf(other, shapeOf(patches[other]));
  const int n = unpackedSegments(factors[number].segments)[side];
  for (int q = 1; q < n; ++q) {
    const int from = patternSideSlot(theirs, otherSide, (neighbour & 1) == 1 ? n - q : q, n);
    vertexWords[2u * (slotOffsets[number].x + uint(patternSideSlot(mine, side, q, n)))] =
        uvec4(vertexWords[2u * (slotOffsets[other].x + uint(from))].xyz, patch_.material);
  }
}
