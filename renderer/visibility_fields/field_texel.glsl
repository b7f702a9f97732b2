// SPDX-License-Identifier: BSD-3-Clause
// Reading texels of fields. The program is compiled with VisibilityFields::defines() and set up by VisibilityFields::bind().
#include "renderer/visibility_fields/field_bindings.h"
#include "renderer/visibility_fields/field_words.h"
#include "renderer/visibility_fields/map_functions.h"

layout(binding = kFieldWordsUnit) uniform usampler2DArray fieldWords;
layout(std430, binding = kFieldMapsBuffer) readonly buffer FieldMaps { vec4 fieldMaps[]; };

#ifdef FIELD_VARIED
// FIELD_SEGMENTS, FIELD_SIDE, FIELD_BITS and FIELD_POSITIONS are these: of the object that fieldUse() chose.
int fieldSegments = 1, fieldSide = 1, fieldBits = 8, fieldPositions = 1;
int fieldFirstMap = 0, fieldFirstSlice = 0;
void fieldUse(FieldObject object) {
  const uint form = uint(object.axisX.w);
  fieldSegments = int(form & 0xffu), fieldSide = int(form >> 8 & 0x1ffu), fieldBits = int(form >> 17 & 0x3fu);
  fieldPositions = int(object.axisZ.w);
  fieldFirstMap = int(object.firstMap), fieldFirstSlice = int(object.axisY.w);
}
#else
const int fieldFirstMap = 0, fieldFirstSlice = 0;
void fieldUse(FieldObject object) {}
#endif
// Mean distances between neighbouring positions, and between rays of neighbouring texels at the distance of a radius, in radii
// (fieldSpacing() of cpu_field.h).
#define FIELD_POSITION_SPACING sqrt(12.5663706 / float(FIELD_POSITIONS))
#define FIELD_TEXEL_SPACING (1.77245385 / float(FIELD_SIDE))

uint fieldWord(int map, ivec2 texel) {
  const ivec2 tile = ivec2((FIELD_SIDE * FIELD_BITS + 31) / 32, FIELD_SIDE);
  const ivec2 word = ivec2(texel.x / (32 / FIELD_BITS), texel.y);
  return texelFetch(fieldWords, fieldWordPlace(map - fieldFirstMap, word, tile, FIELD_SLICE_SIDE) + ivec3(0, 0, fieldFirstSlice), 0).x;
}

#if !defined(FIELD_VARIED) && FIELD_DISTANCE_BITS < FIELD_BITS
const int kFieldNormalBits = (FIELD_BITS - FIELD_DISTANCE_BITS) / 2;
// Normal of what the ray of a texel hits, on the side that it comes from, in the object's axes.
vec3 fieldHitNormal(int map, ivec2 texel) { return fieldNormal(fieldWord(map, texel) >> FIELD_DISTANCE_BITS, kFieldNormalBits); }
#endif

// Distance to what the ray of a texel hits, as a share of the sphere's diameter; -1: nothing.
float fieldShare(int map, ivec2 texel) {
  const uint bits = fieldWord(map, texel);
#ifdef FIELD_VARIED
  if (FIELD_BITS == 32) return uintBitsToFloat(bits);
  const uint code = bitfieldExtract(bits, FIELD_BITS * (texel.x % (32 / FIELD_BITS)), FIELD_BITS);
  if (code == fieldMissCode(FIELD_BITS)) return -1.0;
  return FIELD_BITS == 1 ? fieldMaps[map].w : float(code) * fieldCodeStep(FIELD_BITS);
#elif FIELD_DISTANCE_BITS < FIELD_BITS
  const uint code = bits & fieldMissCode(FIELD_DISTANCE_BITS);
  return code == fieldMissCode(FIELD_DISTANCE_BITS) ? -1.0 : float(code) * fieldCodeStep(FIELD_DISTANCE_BITS);
#elif FIELD_BITS == 32
  return uintBitsToFloat(bits);
#else
  const uint code = bitfieldExtract(bits, FIELD_BITS * (texel.x % (32 / FIELD_BITS)), FIELD_BITS);
  if (code == fieldMissCode(FIELD_BITS)) return -1.0;
#if FIELD_BITS == 1
  return fieldMaps[map].w;
#else
  return float(code) * fieldCodeStep(FIELD_BITS);
#endif
#endif
}
