// SPDX-License-Identifier: BSD-3-Clause
// One level of the pyramid from the finer one, exactly: five taps, then bilinear, along both axes out of shared
// memory. Each group takes a tile of the finer level and the coarse samples around it; it writes the coarse
// samples that lie in its tile, and (BAND) the tile less what the coarse samples interpolate to: band 0, or a
// level of the Laplacian pyramid. Sums are of differences, so that a
// flat image stays flat to the last bit and a faint band is as exact as a strong one.
#include "perception/threshold_maps/common.glsl"

layout(local_size_x = 256) in;
layout(binding = 0) uniform sampler2D source;
layout(binding = 0, r32f) uniform writeonly image2D coarser;
#if BAND == 32
layout(binding = 1, r32f) uniform writeonly image2D band;
#elif BAND == 16
layout(binding = 1, r16f) uniform writeonly image2D band;
#endif
uniform int sourceLevel;

const ivec2 kTile = ivec2(64, 32);
const ivec2 kCoarse = ivec2(34, 18);  // samples around a tile
const ivec2 kRegion = ivec2(76, 44);  // finer ones that they are made of
shared float region[kRegion.x * kRegion.y];
// As a sample near by and what to add: what is small beside a band must not be lost beside the luminance.
shared vec2 filteredRows[kCoarse.x * kRegion.y];
shared vec2 coarse[kCoarse.x * kCoarse.y];

// Six weights of a sample `t` right of tap 2.
float weightOf(int tap, float t) {
  float taps[7] = float[7](0.0, run.kernel.x, run.kernel.y, run.kernel.z, run.kernel.y, run.kernel.x, 0.0);
  return mix(taps[tap + 1], taps[tap], t);
}

void weightsOf(float t, out float w[6]) {
  for (int tap = 0; tap < 6; ++tap) w[tap] = weightOf(tap, t);
}

vec2 filtered(vec2 v[6], float w[6]) {
  float sum = 0.0;
  for (int tap = 0; tap < 6; ++tap) sum += w[tap] * ((v[tap].x - v[2].x) + v[tap].y);
  return vec2(v[2].x, sum);
}

// How far a coarse sample lies above a value.
float above(vec2 sampled, float value) { return (sampled.x - value) + sampled.y; }

void main() {
  int thread = int(gl_LocalInvocationIndex);
#if FROM_LEVEL
  ivec2 fineSize = textureSize(source, sourceLevel);
#else
  ivec2 fineSize = textureSize(source, 0);
#endif
  ivec2 coarseSize = imageSize(coarser);
  ivec2 origin = ivec2(gl_WorkGroupID.xy) * kTile;
  ivec2 last = min(origin + kTile, fineSize) - 1;

  ivec2 first, end;  // coarse samples around the tile
  ivec2 from, to;    // finer samples of those
  vec2 ignored;
  place(origin.x, coarseSize.x, fineSize.x, first.x, ignored.x);
  place(origin.y, coarseSize.y, fineSize.y, first.y, ignored.y);
  place(last.x, coarseSize.x, fineSize.x, end.x, ignored.x);
  place(last.y, coarseSize.y, fineSize.y, end.y, ignored.y);
  end += 2;
  ivec2 inside = clamp(first, ivec2(0), coarseSize - 1), insideEnd = clamp(end - 1, ivec2(0), coarseSize - 1);
  place(inside.x, fineSize.x, coarseSize.x, from.x, ignored.x);
  place(inside.y, fineSize.y, coarseSize.y, from.y, ignored.y);
  place(insideEnd.x, fineSize.x, coarseSize.x, to.x, ignored.x);
  place(insideEnd.y, fineSize.y, coarseSize.y, to.y, ignored.y);
  from -= 2;
  to += 4;
  ivec2 extent = to - from, count = end - first;

  for (int i = thread; i < kRegion.x * extent.y; i += 256) {
    ivec2 at = ivec2(i % kRegion.x, i / kRegion.x);
    if (at.x >= extent.x) continue;
    ivec2 texel = ivec2(borderIndex(from.x + at.x, fineSize.x), borderIndex(from.y + at.y, fineSize.y));
#if FROM_LEVEL
    region[i] = texelFetch(source, texel, sourceLevel).r;
#else
    region[i] = luminanceOf(texelFetch(source, texel, 0));
#endif
  }
  barrier();

  for (int i = thread; i < kCoarse.x * extent.y; i += 256) {
    ivec2 at = ivec2(i % kCoarse.x, i / kCoarse.x);
    if (at.x >= count.x) continue;
    int left;
    float t;
    place(clamp(first.x + at.x, 0, coarseSize.x - 1), fineSize.x, coarseSize.x, left, t);
    float w[6];
    vec2 v[6];
    weightsOf(t, w);
    for (int tap = 0; tap < 6; ++tap)
      v[tap] = vec2(region[at.y * kRegion.x + left - 2 + tap - from.x], 0.0);
    filteredRows[i] = filtered(v, w);
  }
  barrier();

  // Those whose place on the finer level is in the tile are this group's to write.
  ivec2 ownFirst, ownEnd;
  vec2 t;
  place(origin.x, coarseSize.x, fineSize.x, ownFirst.x, t.x);
  place(origin.y, coarseSize.y, fineSize.y, ownFirst.y, t.y);
  ownFirst += ivec2(t.x > 0.0, t.y > 0.0);
  place(origin.x + kTile.x, coarseSize.x, fineSize.x, ownEnd.x, t.x);
  place(origin.y + kTile.y, coarseSize.y, fineSize.y, ownEnd.y, t.y);
  ownEnd += ivec2(t.x > 0.0, t.y > 0.0);
  if (origin.x + kTile.x >= fineSize.x) ownEnd.x = coarseSize.x;
  if (origin.y + kTile.y >= fineSize.y) ownEnd.y = coarseSize.y;
  for (int i = thread; i < kCoarse.x * count.y; i += 256) {
    ivec2 at = ivec2(i % kCoarse.x, i / kCoarse.x), sampleAt = first + at;
    if (at.x >= count.x) continue;
    int left;
    float ty;
    place(clamp(sampleAt.y, 0, coarseSize.y - 1), fineSize.y, coarseSize.y, left, ty);
    float w[6];
    vec2 v[6];
    weightsOf(ty, w);
    for (int tap = 0; tap < 6; ++tap) v[tap] = filteredRows[(left - 2 + tap - from.y) * kCoarse.x + at.x];
    vec2 value = filtered(v, w);
    coarse[i] = value;
    if (all(greaterThanEqual(sampleAt, ownFirst)) && all(lessThan(sampleAt, ownEnd)))
      imageStore(coarser, sampleAt, vec4(value.x + value.y));
  }
#if BAND
  barrier();
  int x = origin.x + thread % kTile.x;
  if (x >= fineSize.x) return;
  int left;
  float tx;
  place(x, coarseSize.x, fineSize.x, left, tx);
  int column = left - first.x;
  for (int y = origin.y + thread / kTile.x; y <= last.y; y += 256 / kTile.x) {
    int top;
    float ty;
    place(y, coarseSize.y, fineSize.y, top, ty);
    int at = (top - first.y) * kCoarse.x + column;
    float value = region[(y - from.y) * kRegion.x + x - from.x];
    float a = above(coarse[at], value), b = above(coarse[at + 1], value);
    float c = above(coarse[at + kCoarse.x], value), d = above(coarse[at + kCoarse.x + 1], value);
    float upper = a + tx * (b - a), lower = c + tx * (d - c);
    float difference = -(upper + ty * (lower - upper));
#if BAND == 16
    difference = sign(difference) * sqrt(abs(difference));  // for the range of 16 bits
#endif
    imageStore(band, ivec2(x, y), vec4(difference));
  }
#endif
}
