// SPDX-License-Identifier: BSD-3-Clause
// Post-process (SC-74): of two patches along a side the later one gets the earlier one's positions, whatever evaluated them.
// An invocation for each side. Corners, of which both are evaluated directly, are left as they are.
#include "renderer/techniques/tessellation/compute/slots.glsl"

layout(std430, binding = kVerticesBuffer) buffer Vertices { TessellatedVertex vertices[]; };

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
    vertices[slotOffsets[number].x + uint(patternSideSlot(mine, side, q, n))].position =
        vertices[slotOffsets[other].x + uint(from)].position;
  }
}
