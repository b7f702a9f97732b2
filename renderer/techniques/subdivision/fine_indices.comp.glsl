// SPDX-License-Identifier: BSD-3-Clause
// Triangles of the drawn mesh, once for a level; an invocation a triangle.
#include "renderer/techniques/subdivision/tables.glsl"

layout(local_size_x = kSubdivisionGroup) in;
layout(std430, binding = kFineIndicesBuffer) writeonly buffer FineIndices { uint fineIndices[]; };

uniform int segments;
uniform uint triangleCount;

void put(uint number, uint patchNumber, ivec2 a, ivec2 b, ivec2 c) {
  const SubdivisionPatch record = patches[patchNumber];
  fineIndices[3u * number] = drawnVertex(patchNumber, record, a, segments);
  fineIndices[3u * number + 1u] = drawnVertex(patchNumber, record, b, segments);
  fineIndices[3u * number + 2u] = drawnVertex(patchNumber, record, c, segments);
}

void main() {
  const uint number = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * uint(kSubdivisionGroup);
  if (number >= triangleCount) return;
#if CORNERS == 3
  const uint each = uint(segments * segments), patchNumber = number / each, at = number % each;
  // Row y has 2 (n - y) - 1 triangles; y^2 - 2 n y + at = 0 gives the row.
  int y = int(float(segments) - sqrt(float(each - at)));
  y = clamp(y, 0, segments - 1);
  while (y > 0 && uint(y * (2 * segments - y)) > at) --y;
  while (uint((y + 1) * (2 * segments - y - 1)) <= at) ++y;
  const int inRow = int(at) - y * (2 * segments - y), x = inRow / 2;
  if (inRow % 2 == 0)
    put(number, patchNumber, ivec2(x, y), ivec2(x + 1, y), ivec2(x, y + 1));
  else
    put(number, patchNumber, ivec2(x + 1, y), ivec2(x + 1, y + 1), ivec2(x, y + 1));
#else
  const uint each = uint(2 * segments * segments), patchNumber = number / each, at = number % each;
  const ivec2 cell = ivec2(int(at / 2u) % segments, int(at / 2u) / segments);
  if (at % 2u == 0u)
    put(number, patchNumber, cell, cell + ivec2(1, 0), cell + ivec2(1));
  else
    put(number, patchNumber, cell, cell + ivec2(1), cell + ivec2(0, 1));
#endif
}
