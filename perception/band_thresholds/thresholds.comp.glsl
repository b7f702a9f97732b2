// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of one band at its own size: of the band alone, and of differences of any spectrum combined with
// those of the coarser bands. Groups compute the thresholds of a tile and of what its smallest ones are taken from.
#include "perception/band_thresholds/band_threshold_bindings.h"

layout(local_size_x = kBandThreads) in;
layout(binding = kBandLevelsUnit) uniform sampler2D levels;
layout(binding = kBandCoarserUnit) uniform sampler2D coarser;
#if COMBINED
layout(binding = kBandCombinedImage, r32f) uniform writeonly image2D combined;
#endif
#if OWN
layout(binding = kBandOwnImage, r32f) uniform writeonly image2D own;
#endif
layout(std430, binding = kBandSensitivitiesBuffer) readonly buffer Sensitivities { vec2 sensitivities[]; };
layout(std430, binding = kBandStepsBuffer) readonly buffer Steps { vec2 steps[]; };
uniform int level, adaptationLevel, coarserLevel;
uniform ivec2 origin;  // the first sample to compute; even or odd
uniform vec2 evenTaps;  // of the upsampler: outer and centre weight at even samples; odd ones have 1/2, 1/2
uniform float epsilon, gain, spread, fixedLuminance;

const ivec2 kTile = ivec2(kBandTileX, kBandTileY);
const ivec2 kAround = kTile + 2 * REACH;
const ivec2 kNext = kAround / 2 + 3;
// The two coarser levels at the size of the next one.
shared vec2 next[kNext.x * kNext.y];
#if COMBINED
shared float allowed[kAround.x * kAround.y];
shared float rows[kTile.x * kAround.y];
#endif

// Weights of samples m - 1, m, m + 1 of the coarser level for a sample at 2 m or 2 m + 1.
vec3 taps(int place) { return (place & 1) == 0 ? evenTaps.xyx : vec3(0.0, 0.5, 0.5); }

void loadNext(int thread, ivec2 from) {
  ivec2 nextSize = textureSize(levels, level + 1), afterSize = textureSize(levels, level + 2);
  for (int i = thread; i < kNext.x * kNext.y; i += kBandThreads) {
    ivec2 place = clamp(from + ivec2(i % kNext.x, i / kNext.x), ivec2(0), nextSize - 1), centre = place / 2;
    vec3 across = taps(place.x), down = taps(place.y);
    float middle = texelFetch(levels, min(centre, afterSize - 1), level + 2).r, sum = 0.0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        ivec2 at = clamp(centre + ivec2(dx, dy), ivec2(0), afterSize - 1);
        sum += across[dx + 1] * down[dy + 1] * (texelFetch(levels, at, level + 2).r - middle);
      }
    next[i] = vec2(texelFetch(levels, place, level + 1).r, middle + sum);
  }
}

float luminanceAt(ivec2 place) {
#if FIXED_ADAPTATION
  return fixedLuminance;
#else
  int from = max(adaptationLevel, level), shift = from - level;
  ivec2 last = textureSize(levels, from) - 1, first = place >> shift;
  vec2 t = vec2(place - (first << shift)) / float(1 << shift);
  ivec2 second = min(first + 1, last);
  first = min(first, last);
  float a = texelFetch(levels, first, from).r, b = texelFetch(levels, ivec2(second.x, first.y), from).r;
  float c = texelFetch(levels, ivec2(first.x, second.y), from).r, d = texelFetch(levels, second, from).r;
  return mix(mix(a, b, t.x), mix(c, d, t.x), t.y);
#endif
}

float sensitivityAt(float luminance) {
  float lg = clamp(log2(max(luminance, 1e-4)) * 0.30102999566, kBandLgLow, 6.0);
  float place = (lg - kBandLgLow) * float(kBandCellsPerDecade);
  int cell = min(int(place), kBandCells - 1);
  vec2 entry = sensitivities[level * kBandCells + cell];
  return entry.x + entry.y * (place - float(cell));
}

// Octave and place in it are the number's own bits.
float stepOf(float normalised) {
  const uint kFirst = uint(127 + kBandLowOctave) << kBandSegmentBits;
  const uint kLast = uint(kBandOctaves << kBandSegmentBits) - 1u;
  const int kRest = 23 - kBandSegmentBits;
  uint bits = floatBitsToUint(max(normalised, exp2(float(kBandLowOctave))));
  vec2 segment = steps[min((bits >> kRest) - kFirst, kLast)];
  return segment.x + segment.y * float(bits & ((1u << kRest) - 1u)) / float(1 << kRest);
}

// Thresholds at a sample: of the band alone, of any spectrum.
vec2 thresholdsAt(ivec2 place, ivec2 nextFrom) {
  ivec2 m = (place >> 1) - nextFrom;
  vec3 across = taps(place.x), down = taps(place.y);
  vec2 middle = next[m.y * kNext.x + m.x], sum = vec2(0.0);
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      sum += across[dx + 1] * down[dy + 1] * (next[(m.y + dy) * kNext.x + m.x + dx] - middle);
  float denominator = max(middle.y + sum.y, epsilon);
  float band = (texelFetch(levels, place, level).r - middle.x) - sum.x;
  float contrast = abs(band) / (denominator * gain);
  float s = max(sensitivityAt(luminanceAt(place)), 1e-6);
  float contrastStep = stepOf(contrast * s) / s;
  return contrastStep * denominator * vec2(gain, 1.0 / (spread + 1.5 * contrast + contrastStep));
}

void main() {
  int thread = int(gl_LocalInvocationIndex);
  ivec2 size = textureSize(levels, level), tile = origin + ivec2(gl_WorkGroupID.xy) * kTile;
  ivec2 from = tile - REACH, nextFrom = (from >> 1) - 1;
  loadNext(thread, nextFrom);
  barrier();
  for (int i = thread; i < kAround.x * kAround.y; i += kBandThreads) {
    ivec2 place = from + ivec2(i % kAround.x, i / kAround.x), inside = clamp(place, ivec2(0), size - 1);
    vec2 thresholds = thresholdsAt(inside, nextFrom);
#if COMBINED
    allowed[i] = thresholds.y;
#endif
#if OWN
    if (place == inside && all(greaterThanEqual(place, tile)) && all(lessThan(place, tile + kTile)))
      imageStore(own, place, vec4(thresholds.x));
#endif
  }
#if COMBINED
  barrier();
  for (int i = thread; i < kTile.x * kAround.y; i += kBandThreads) {
    int at = i / kTile.x * kAround.x + i % kTile.x;
    float least = allowed[at];
    for (int k = 1; k <= 2 * REACH; ++k) least = min(least, allowed[at + k]);
    rows[i] = least;
  }
  barrier();
  for (int i = thread; i < kTile.x * kTile.y; i += kBandThreads) {
    ivec2 place = tile + ivec2(i % kTile.x, i / kTile.x);
    if (any(greaterThanEqual(place, size))) continue;
    float least = rows[i];
    for (int k = 1; k <= 2 * REACH; ++k) least = min(least, rows[i + k * kTile.x]);
#if COARSER
    ivec2 last = textureSize(coarser, coarserLevel) - 1, a = min(place >> 1, last), b = min((place >> 1) + 1, last);
    vec2 t = 0.5 * vec2(place & 1);
    float above = mix(texelFetch(coarser, a, coarserLevel).r, texelFetch(coarser, ivec2(b.x, a.y), coarserLevel).r, t.x);
    float below = mix(texelFetch(coarser, ivec2(a.x, b.y), coarserLevel).r, texelFetch(coarser, b, coarserLevel).r, t.x);
    least = min(least, mix(above, below, t.y));
#endif
    imageStore(combined, place, vec4(least));
  }
#endif
}
