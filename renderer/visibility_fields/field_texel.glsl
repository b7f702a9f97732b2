// SPDX-License-Identifier: BSD-3-Clause
// Reading texels of fields. The program is compiled with VisibilityFields::defines() and set up by VisibilityFields::bind().
#include "renderer/visibility_fields/field_bindings.h"
#include "renderer/visibility_fields/field_words.h"
#include "renderer/visibility_fields/map_functions.h"

layout(binding = kFieldWordsUnit) uniform usampler2DArray fieldWords;
layout(std430, binding = kFieldMapsBuffer) readonly buffer FieldMaps { vec4 fieldMaps[]; };

const int kFieldTexelsPerWord = 32 / FIELD_BITS;
const ivec2 kFieldTile = ivec2((FIELD_SIDE * FIELD_BITS + 31) / 32, FIELD_SIDE);

uint fieldWord(int map, ivec2 texel) {
  const ivec2 word = ivec2(texel.x / kFieldTexelsPerWord, texel.y);
  return texelFetch(fieldWords, fieldWordPlace(map, word, kFieldTile, FIELD_SLICE_SIDE), 0).x;
}

#if FIELD_DISTANCE_BITS < FIELD_BITS
const int kFieldNormalBits = (FIELD_BITS - FIELD_DISTANCE_BITS) / 2;
// Normal of what the ray of a texel hits, on the side that it comes from, in the object's axes.
vec3 fieldHitNormal(int map, ivec2 texel) { return fieldNormal(fieldWord(map, texel) >> FIELD_DISTANCE_BITS, kFieldNormalBits); }
#endif

// Distance to what the ray of a texel hits, as a share of the sphere's diameter; -1: nothing.
float fieldShare(int map, ivec2 texel) {
  const uint bits = fieldWord(map, texel);
#if FIELD_DISTANCE_BITS < FIELD_BITS
  const uint code = bits & fieldMissCode(FIELD_DISTANCE_BITS);
  return code == fieldMissCode(FIELD_DISTANCE_BITS) ? -1.0 : float(code) * fieldCodeStep(FIELD_DISTANCE_BITS);
#elif FIELD_BITS == 32
  return uintBitsToFloat(bits);
#else
  const uint code = bitfieldExtract(bits, FIELD_BITS * (texel.x % kFieldTexelsPerWord), FIELD_BITS);
  if (code == fieldMissCode(FIELD_BITS)) return -1.0;
#if FIELD_BITS == 1
  return fieldMaps[map].w;
#else
  return float(code) * fieldCodeStep(FIELD_BITS);
#endif
#endif
}
