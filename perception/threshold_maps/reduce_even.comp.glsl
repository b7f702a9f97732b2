// SPDX-License-Identifier: BSD-3-Clause
// One level of the pyramid from the finer one where both sides are even: a coarse sample lies in the middle of four
// finer ones, so that all have the same six taps. From the input, luminance is stored as well. Each group makes
// TILE / 2 coarse samples. Sums are of differences, so that a flat image stays flat to the last bit; of level 1 what
// rounding takes away is stored beside it, since the finest band, which may be fainter than that, is the difference.
#include "perception/threshold_maps/threshold_map_bindings.h"
#include "perception/threshold_maps/common.glsl"

layout(local_size_x = THREADS) in;
layout(binding = kCoarsenSourceUnit) uniform sampler2D source;
layout(binding = kCoarsenCoarserImage, r32f) uniform writeonly image2D coarser;
#if !FROM_LEVEL
layout(binding = kCoarsenBandImage, r32f) uniform writeonly image2D luminance;
layout(binding = kCoarsenRestImage, r16f) uniform writeonly image2D rest;
#endif
uniform int sourceLevel;

const ivec2 kTile = ivec2(TILE_X, TILE_Y);
const ivec2 kCoarse = kTile / 2;
const ivec2 kRegion = kTile + 4;
const int kLoads = (kRegion.x * kRegion.y + THREADS - 1) / THREADS;
shared float region[kRegion.x * kRegion.y];
// What a filtered sample has more than the finer one at its tap 2.
shared float rowExcess[kCoarse.x * kRegion.y];

// Weighted sum of differences of six samples from the third, `c`.
float excess(float a, float b, float c, float d, float e, float f) {
  float outer = 0.5 * run.kernel.x, inner = 0.5 * (run.kernel.x + run.kernel.y),
        middle = 0.5 * (run.kernel.y + run.kernel.z);
  return outer * ((a - c) + (f - c)) + inner * ((b - c) + (e - c)) + middle * (d - c);
}

void main() {
  int thread = int(gl_LocalInvocationIndex);
#if FROM_LEVEL
  ivec2 size = textureSize(source, sourceLevel);
#else
  ivec2 size = textureSize(source, 0);
#endif
  ivec2 origin = ivec2(gl_WorkGroupID.xy) * kTile, from = origin - 2;
  // All loads of an invocation are under way before the first is used.
  float values[kLoads];
  for (int k = 0; k < kLoads; ++k) {
    int i = min(thread + k * THREADS, kRegion.x * kRegion.y - 1);
    ivec2 at = from + ivec2(i % kRegion.x, i / kRegion.x);
    at = ivec2(borderIndex(at.x, size.x), borderIndex(at.y, size.y));
#if FROM_LEVEL
    values[k] = texelFetch(source, at, sourceLevel).r;
#else
    values[k] = luminanceOf(texelFetch(source, at, 0));
#endif
  }
  for (int k = 0; k < kLoads; ++k) {
    int i = thread + k * THREADS;
    if (i < kRegion.x * kRegion.y) region[i] = values[k];
  }
  barrier();
#if !FROM_LEVEL
  for (int i = thread; i < kTile.x * kTile.y; i += THREADS) {
    ivec2 local = ivec2(i % kTile.x, i / kTile.x), at = origin + local;
    if (all(lessThan(at, size)))
      imageStore(luminance, at, vec4(region[(local.y + 2) * kRegion.x + local.x + 2]));
  }
#endif
  for (int i = thread; i < kCoarse.x * kRegion.y; i += THREADS) {
    int at = i / kCoarse.x * kRegion.x + 2 * (i % kCoarse.x);
    rowExcess[i] =
        excess(region[at], region[at + 1], region[at + 2], region[at + 3], region[at + 4], region[at + 5]);
  }
  barrier();
  for (int i = thread; i < kCoarse.x * kCoarse.y; i += THREADS) {
    ivec2 local = ivec2(i % kCoarse.x, i / kCoarse.x), at = origin / 2 + local;
    if (any(greaterThanEqual(at, size / 2))) continue;
    // Of each of the six rows: tap 2 and what the row has more.
    int column = 2 * local.y * kRegion.x + 2 * local.x + 2, row = 2 * local.y * kCoarse.x + local.x;
    float near = region[column + 2 * kRegion.x], more[6];
    for (int k = 0; k < 6; ++k)
      more[k] = (region[column + k * kRegion.x] - near) + rowExcess[row + k * kCoarse.x];
    float sum = more[2] + excess(more[0], more[1], more[2], more[3], more[4], more[5]), value = near + sum;
    imageStore(coarser, at, vec4(value));
#if !FROM_LEVEL
    precise float lost = (near - value) + sum;
    imageStore(rest, at, vec4(value > 0.0 ? lost * kRestScale / value : 0.0));
#endif
  }
}
