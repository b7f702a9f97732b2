// SPDX-License-Identifier: BSD-3-Clause
// Sums of control vertices by rows of tables (Holländer 2013, equation 2.1). Needs CORNERS and TABLE_SEGMENTS.
// TEXTURED: patches have texture coordinates.
#include "renderer/techniques/subdivision/subdivision_bindings.h"

layout(std430, binding = kSubdivisionPatchesBuffer) readonly buffer Patches { SubdivisionPatch patches[]; };
layout(std430, binding = kSubdivisionPointsBuffer) readonly buffer Points { uint points[]; };
layout(std430, binding = kSubdivisionTablesBuffer) readonly buffer Tables { float tables[]; };
layout(std430, binding = kSubdivisionPlacesBuffer) readonly buffer Places { uint places[]; };
layout(std430, binding = kControlsBuffer) readonly buffer Controls { vec4 controls[]; };  // ControlVertex

uniform uint rows;           // of a table
uniform uint tangentStride;  // GEOMETRY_NORMALS: from weights of positions to those of a tangent, and on to the other's

#include "renderer/techniques/subdivision/places.glsl"

// In segments of the tables.
ivec2 placeOfRow(uint row) { return ivec2(places[row] & 65535u, places[row] >> 16); }
uint rowOfPlace(ivec2 place) { return places[rows + uint(place.x + place.y * (TABLE_SEGMENTS + 1))]; }

vec3 tablePosition(uint patchNumber, uint row) {
  const SubdivisionPatch record = patches[patchNumber];
  precise vec3 sum = vec3(0.0);
  for (uint s = 0u; s < record.points; ++s)
    sum = fma(vec3(tables[record.firstWeight + s * rows + row]), controls[2u * points[record.firstPoint + s]].xyz, sum);
  return sum;
}

#ifdef TEXTURED
layout(binding = kPatchAttributesUnit) uniform usampler2D patchAttributes;

// Each patch has its own, so that seams divide them.
vec2 tableTexture(uint patchNumber, uint row) {
  const uint at = patchNumber * rows + row, across = uint(kPatchAttributesAcross);
  return unpackUnorm2x16(texelFetch(patchAttributes, ivec2(at % across, at / across), 0).x);
}
#endif

vec3 unitOr(vec3 v, vec3 otherwise) {
  const float size = max(abs(v.x), max(abs(v.y), abs(v.z)));
  return size > 1e-30 ? normalize(v / size) : otherwise;
}

vec3 tableNormal(uint patchNumber, uint row) {
  const SubdivisionPatch record = patches[patchNumber];
#ifdef GEOMETRY_NORMALS
  vec3 a = vec3(0.0), b = vec3(0.0);
  for (uint s = 0u; s < record.points; ++s) {
    const vec3 p = controls[2u * points[record.firstPoint + s]].xyz;
    const uint at = record.firstWeight + s * rows + row + tangentStride;
    a += tables[at] * p;
    b += tables[at + tangentStride] * p;
  }
  const vec3 sum = cross(a, b);
#else
  vec3 sum = vec3(0.0);
  for (uint s = 0u; s < record.points; ++s)
    sum += tables[record.firstWeight + s * rows + row] * controls[2u * points[record.firstPoint + s] + 1u].xyz;
#endif
  return unitOr(sum, vec3(0.0, 0.0, 1.0));
}

// The patch and the row that give the position of a place, the same for all patches that have it. In segments of the tables.
uvec2 sourceOf(uint patchNumber, ivec2 place) {
  const SubdivisionPatch record = patches[patchNumber];
  int along;
  const int side = sideOf(place, TABLE_SEGMENTS, along);
  if (side >= 8) {
    const uint source = record.cornerSources[side - 8];
    return uvec2(source >> 2, rowOfPlace(placeOfCorner(int(source & 3u), TABLE_SEGMENTS)));
  }
  if (side >= 0) {
    const uint source = record.edgeSources[side];
    if ((source & 1u) != 0u) along = TABLE_SEGMENTS - along;
    return uvec2(source >> 3, rowOfPlace(placeOnSide(int(source >> 1 & 3u), along, TABLE_SEGMENTS)));
  }
  return uvec2(patchNumber, rowOfPlace(place));
}
