// SPDX-License-Identifier: BSD-3-Clause
// Main step (Holländer 2013, section 2.2.3) in compute: a work group makes the vertices inside a patch and those of the
// sides and corners that are its own to write; the control vertices are read once, into shared memory.
#include "renderer/techniques/tessellation/tessellation_bindings.h"
#include "renderer/techniques/subdivision/tables.glsl"

layout(local_size_x = kSubdivisionGroup) in;
layout(std430, binding = kFineVerticesBuffer) writeonly buffer FineVertices { uvec4 fineVertices[]; };  // TessellatedVertex

uniform uint rowsOfLevel;
uniform int segments;
uniform uint patchCount;

shared vec4 near[2 * kSubdivisionSlots];
shared SubdivisionPatch own;

void main() {
  const uint number = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (number >= patchCount) return;
  const uint lane = gl_LocalInvocationIndex;
  if (lane == 0u) own = patches[number];
  barrier();
  for (uint i = lane; i < 2u * own.points; i += uint(kSubdivisionGroup))
    near[i] = controls[2u * points[own.firstPoint + i / 2u] + (i & 1u)];
  barrier();
  const int step = TABLE_SEGMENTS / segments;
  const uint count = own.points, firstWeight = own.firstWeight, writes = own.writes;
  for (uint row = lane; row < rowsOfLevel; row += uint(kSubdivisionGroup)) {
    const ivec2 place = placeOfRow(row) / step;
    int along;
    const int side = sideOf(place, segments, along);
    const uint bit = side >= 8 ? uint(side - 4) : uint(max(side, 0));
    if (side >= 0 && ((writes >> bit) & 1u) == 0u) continue;
    precise vec3 position = vec3(0.0);
    vec3 normal = vec3(0.0);
#ifdef GEOMETRY_NORMALS
    vec3 a = vec3(0.0), b = vec3(0.0);
#endif
    for (uint s = 0u; s < count; ++s) {
      const float weight = tables[firstWeight + s * rows + row];
      position = fma(vec3(weight), near[2u * s].xyz, position);
#ifdef GEOMETRY_NORMALS
      const uint at = firstWeight + s * rows + row + tangentStride;
      a += tables[at] * near[2u * s].xyz;
      b += tables[at + tangentStride] * near[2u * s].xyz;
#else
      normal += weight * near[2u * s + 1u].xyz;
#endif
    }
#ifdef GEOMETRY_NORMALS
    normal = cross(a, b);
#endif
    if (side >= 0) {
      const uvec2 source = sourceOf(number, place * step);
      if (source.x != number || source.y != row) position = tablePosition(source.x, source.y);
    }
    normal = unitOr(normal, vec3(0.0, 0.0, 1.0));
    const uint target = drawnVertex(number, own, place, segments);
    fineVertices[2u * target] = uvec4(floatBitsToUint(position), own.material);
    fineVertices[2u * target + 1u] = uvec4(floatBitsToUint(normal), kRungField);
  }
}
