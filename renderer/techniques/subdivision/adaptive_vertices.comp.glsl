// SPDX-License-Identifier: BSD-3-Clause
// Vertices of a patch, a group each, at the largest of its sides' levels. On a side of a lower level they go to the nearest of
// its places. A real level morphs: places that the next lower level does not have come from between two that it has.
#include "renderer/techniques/tessellation/tessellation_bindings.h"
#include "renderer/techniques/subdivision/tables.glsl"

layout(local_size_x = kSubdivisionGroup) in;
layout(std430, binding = kEdgeLevelsBuffer) readonly buffer EdgeLevels { float edgeLevels[]; };
layout(std430, binding = kPatchOffsetsBuffer) readonly buffer Offsets { uvec2 offsets[]; };
layout(std430, binding = kFineVerticesBuffer) writeonly buffer FineVertices { uvec4 fineVertices[]; };
uniform uint patchCount;

struct Point {
  vec3 position, normal;
  vec2 texture_;  // TEXTURED only
};

Point exactPoint(uint number, ivec2 place) {
  const uvec2 source = sourceOf(number, place);
  Point point = Point(tablePosition(source.x, source.y), tableNormal(number, rowOfPlace(place)), vec2(0.0));
#ifdef TEXTURED
  point.texture_ = tableTexture(number, rowOfPlace(place));
#endif
  return point;
}

Point between(Point a, Point b, Point at, float share) {
  precise vec3 position = 0.5 * (a.position + b.position);
  position = position + share * (at.position - position);
  return Point(position, unitOr(mix(0.5 * (a.normal + b.normal), at.normal, share), at.normal),
               mix(0.5 * (a.texture_ + b.texture_), at.texture_, share));
}

// A place of the patch's sides.
Point sidePoint(uint number, int side, int along) {
  const float level = edgeLevels[patches[number].edges[side]];
  const int whole = int(ceil(level)), step = TABLE_SEGMENTS >> whole;
  const int at = (along + step / 2) / step;
  const float share = level - float(whole - 1);
  const Point exact = exactPoint(number, placeOnSide(side, at * step, TABLE_SEGMENTS));
  if ((at & 1) == 0 || share >= 1.0) return exact;
  return between(exactPoint(number, placeOnSide(side, (at - 1) * step, TABLE_SEGMENTS)),
                 exactPoint(number, placeOnSide(side, (at + 1) * step, TABLE_SEGMENTS)), exact, share);
}

// As it is drawn if no morph is under way inside.
Point drawnPoint(uint number, ivec2 place) {
  int along;
  const int side = sideOf(place, TABLE_SEGMENTS, along);
  if (side >= 0 && side < 8) return sidePoint(number, side, along);
  return exactPoint(number, place);
}

Point innerPoint(uint number, ivec2 place, float level) {
  const int whole = int(ceil(level)), step = TABLE_SEGMENTS >> whole;
  const float share = level - float(whole - 1);
  const ivec2 odd = (place / step) & 1;
  if (share >= 1.0 || odd == ivec2(0)) return exactPoint(number, place);
#if CORNERS == 3
  const ivec2 away = odd == ivec2(1) ? ivec2(step, -step) : odd * step;
#else
  const ivec2 away = odd * step;
#endif
  return between(drawnPoint(number, place - away), drawnPoint(number, place + away), exactPoint(number, place), share);
}

void main() {
  const uint number = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (number >= patchCount) return;
  float level = 0.0;
  for (int s = 0; s < CORNERS; ++s) level = max(level, edgeLevels[patches[number].edges[s]]);
  const uint first = offsets[number].x, count = offsets[number + 1u].x - first;
  for (uint row = gl_LocalInvocationIndex; row < count; row += uint(kSubdivisionGroup)) {
    const ivec2 place = placeOfRow(row);
    int along;
    const int side = sideOf(place, TABLE_SEGMENTS, along);
    Point point;
    if (side >= 8)
      point = exactPoint(number, place);
    else if (side >= 0)
      point = sidePoint(number, side, along);
    else
      point = innerPoint(number, place, level);
    const uint target = first + row;
    fineVertices[2u * target] = uvec4(floatBitsToUint(point.position), patches[number].material);
#ifdef TEXTURED
    const uint last = packUnorm2x16(point.texture_);
#else
    const uint last = kRungField;
#endif
    fineVertices[2u * target + 1u] = uvec4(floatBitsToUint(point.normal), last);
  }
}
