// SPDX-License-Identifier: BSD-3-Clause
// Triangles of the drawn mesh, once for a level; an invocation a triangle.
#include "renderer/techniques/subdivision/tables.glsl"

layout(local_size_x = kSubdivisionGroup) in;
layout(std430, binding = kFineIndicesBuffer) writeonly buffer FineIndices { uint fineIndices[]; };

uniform int segments;
uniform uint triangleCount;

#include "renderer/techniques/subdivision/grid_triangles.glsl"

void main() {
  const uint number = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * uint(kSubdivisionGroup);
  if (number >= triangleCount) return;
#if CORNERS == 3
  const uint each = uint(segments * segments);
#else
  const uint each = uint(2 * segments * segments);
#endif
  const uint patchNumber = number / each;
  const SubdivisionPatch record = patches[patchNumber];
  const ivec2[3] corners = gridTriangle(number % each, segments);
  for (int c = 0; c < 3; ++c) fineIndices[3u * number + uint(c)] = drawnVertex(patchNumber, record, corners[c], segments);
}
