// SPDX-License-Identifier: BSD-3-Clause
// One level of the predictor's pyramid from the finer one: five taps along each axis, centred on every second
// sample. The first pass also stores luminance. Sums are of differences, so that a flat field stays flat to the
// last bit.
#include "perception/band_thresholds/light.glsl"

layout(local_size_x = kBandReduceX, local_size_y = kBandReduceY) in;
layout(binding = kBandReduceSourceUnit) uniform sampler2D source;
#if FIRST
layout(binding = kBandReduceFineImage, r32f) uniform writeonly image2D fine;
#endif
layout(binding = kBandReduceCoarserImage, r32f) uniform writeonly image2D coarser;
uniform int sourceLevel;
uniform vec3 taps;  // outer, inner, centre

const ivec2 kGroup = ivec2(kBandReduceX, kBandReduceY);
const ivec2 kRegion = 2 * kGroup + 3;
const int kThreads = kBandReduceX * kBandReduceY;
shared float region[kRegion.x * kRegion.y];
shared float rows[kBandReduceX * kRegion.y];

float filtered(float a, float b, float c, float d, float e) {
  return c + taps.x * ((a - c) + (e - c)) + taps.y * ((b - c) + (d - c));
}

void main() {
  int thread = int(gl_LocalInvocationIndex);
  ivec2 origin = ivec2(gl_WorkGroupID.xy) * kGroup, from = 2 * origin - 2;
  ivec2 fineSize = textureSize(source, sourceLevel), coarseSize = imageSize(coarser);
  for (int i = thread; i < kRegion.x * kRegion.y; i += kThreads) {
    ivec2 place = from + ivec2(i % kRegion.x, i / kRegion.x);
    vec4 texel = texelFetch(source, clamp(place, ivec2(0), fineSize - 1), sourceLevel);
#if FIRST
    float value = luminanceOf(texel);
    // Pixels that no other group has: an odd size's last one belongs to the last group.
    ivec2 own = place - 2 * origin;
    bool last = (origin.x + kGroup.x >= coarseSize.x || own.x < 2 * kGroup.x) &&
                (origin.y + kGroup.y >= coarseSize.y || own.y < 2 * kGroup.y);
    if (all(greaterThanEqual(own, ivec2(0))) && last && all(lessThan(place, fineSize)))
      imageStore(fine, place, vec4(value));
#else
    float value = texel.r;
#endif
    region[i] = value;
  }
  barrier();
  for (int i = thread; i < kBandReduceX * kRegion.y; i += kThreads) {
    int at = i / kBandReduceX * kRegion.x + 2 * (i % kBandReduceX);
    rows[i] = filtered(region[at], region[at + 1], region[at + 2], region[at + 3], region[at + 4]);
  }
  barrier();
  ivec2 local = ivec2(gl_LocalInvocationID.xy), place = origin + local;
  if (any(greaterThanEqual(place, coarseSize))) return;
  int at = 2 * local.y * kBandReduceX + local.x;
  imageStore(coarser, place,
             vec4(filtered(rows[at], rows[at + kBandReduceX], rows[at + 2 * kBandReduceX],
                           rows[at + 3 * kBandReduceX], rows[at + 4 * kBandReduceX])));
}
