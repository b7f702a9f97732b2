// SPDX-License-Identifier: BSD-3-Clause
// One word of a field: the rays of its texels against the object, in units of its sphere.
#include "renderer/ray_tracing/trace.glsl"
#include "renderer/visibility_fields/field_bindings.h"
#include "renderer/visibility_fields/field_words.h"
#include "renderer/visibility_fields/map_functions.h"

layout(local_size_x = kFieldMakeGroup) in;
layout(binding = kFieldWordsImage, r32ui) uniform writeonly uimage2DArray fieldWords;
layout(std430, binding = kFieldMapsBuffer) readonly buffer FieldMaps { vec4 fieldMaps[]; };
layout(std430, binding = kFieldCutShortBuffer) buffer CutShort { uint cutShort; };
#if FIELD_BITS == 1
layout(std430, binding = kFieldSumsBuffer) writeonly buffer Sums { vec2 sums[]; };
#endif
#if FIELD_DISTANCE_BITS < FIELD_BITS
// Of each triangle's corners: the normal for shading; in w, of all three, the normal by the order of the corners.
layout(std430, binding = kFieldCornersBuffer) readonly buffer Corners { vec4 corners[]; };
const int kNormalBits = (FIELD_BITS - FIELD_DISTANCE_BITS) / 2;

vec3 hitNormal(RayHit hit, vec3 direction) {
  const vec4 a = corners[3u * hit.triangle], b = corners[3u * hit.triangle + 1u], c = corners[3u * hit.triangle + 2u];
  const vec3 normal = normalize((1.0 - hit.u - hit.v) * a.xyz + hit.u * b.xyz + hit.v * c.xyz);
  // The triangle decides between front and back.
  return dot(vec3(a.w, b.w, c.w), direction) > 0.0 ? -normal : normal;
}
#endif
uniform int firstMap;                // the object's
uniform int firstTile, firstSlice;  // of its words

bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) { return true; }

const int kTexelsPerWord = 32 / FIELD_BITS;
const ivec2 kTile = ivec2((FIELD_SIDE * FIELD_BITS + 31) / 32, FIELD_SIDE);

void main() {
  const int number = int(gl_GlobalInvocationID.x), map = int(gl_WorkGroupID.y);
  if (number >= kTile.x * kTile.y) return;
  const ivec2 word = ivec2(number % kTile.x, number / kTile.x);
  const vec3 position = fieldMaps[firstMap + map].xyz, z = -position;
  const vec3 x = fieldTangent(z), y = fieldBitangent(z);
  uint bits = 0u;
  vec2 sum = vec2(0.0);
  for (int i = 0; i < kTexelsPerWord; ++i) {
    rayIterations += 1;
    const ivec2 texel = ivec2(word.x * kTexelsPerWord + i, word.y);
    if (texel.x >= FIELD_SIDE) break;
    float share = -1.0;
    uint normal = 0u;
    if (fieldTexelUsed(texel, FIELD_SIDE, FIELD_DIRECTION_FORM)) {
      const vec3 local = fieldDirection((vec2(texel) + 0.5) / float(FIELD_SIDE), FIELD_DIRECTION_FORM);
      const vec3 direction = local.x * x + local.y * y + local.z * z;
      const RayHit hit = rayClosestHit(Ray(position, direction, 0.0, 3.0, kRayNoTriangle));
      if (hit.triangle != kRayNoTriangle) {
        share = 0.5 * hit.t;
        sum += vec2(share, 1.0);
#if FIELD_DISTANCE_BITS < FIELD_BITS
        normal = fieldNormalCode(hitNormal(hit, direction), kNormalBits);
#endif
      }
    }
#if FIELD_DISTANCE_BITS < FIELD_BITS
    bits = (share < 0.0 ? fieldMissCode(FIELD_DISTANCE_BITS) : fieldHitCode(share, FIELD_DISTANCE_BITS)) | (normal << FIELD_DISTANCE_BITS);
#elif FIELD_BITS == 32
    bits = floatBitsToUint(share);
#else
    bits |= (share < 0.0 ? fieldMissCode(FIELD_BITS) : fieldHitCode(share, FIELD_BITS)) << uint(FIELD_BITS * i);
#endif
  }
  if (rayCutShort) atomicAdd(cutShort, 1u);
  imageStore(fieldWords, fieldWordPlace(firstTile + map, word, kTile, FIELD_SLICE_SIDE) + ivec3(0, 0, firstSlice), uvec4(bits));
#if FIELD_BITS == 1
  sums[map * kTile.x * kTile.y + number] = sum;
#endif
}
