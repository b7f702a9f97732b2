// SPDX-License-Identifier: BSD-3-Clause
// One level of the pyramid from the finer one, exactly: five taps, then bilinear, along both axes out of shared
// memory. Each group takes a tile of the finer level and the coarse samples around it; it writes the coarse
// samples that lie in its tile, and (BAND) the tile less what the coarse samples interpolate to: band 0, or a
// level of the Laplacian pyramid. Sums are of differences, so that a
// flat image stays flat to the last bit and a faint band is as exact as a strong one.
#include "perception/threshold_maps/threshold_map_bindings.h"
#include "perception/threshold_maps/common.glsl"

layout(local_size_x = THREADS) in;
layout(binding = kCoarsenSourceUnit) uniform sampler2D source;
layout(binding = kCoarsenCoarserImage, r32f) uniform writeonly image2D coarser;
#if BAND == 32
layout(binding = kCoarsenBandImage, r32f) uniform writeonly image2D band;
#elif BAND == 16
layout(binding = kCoarsenBandImage, r16f) uniform writeonly image2D band;
#endif
uniform int sourceLevel;
uniform ivec2 upward[1];    // first entries in Places, columns and rows: finer samples on the coarser level
uniform ivec2 downward[1];  // coarser samples on the finer level

const ivec2 kTile = ivec2(TILE_X, TILE_Y);
const ivec2 kCoarse = kTile / 2 + 2;     // samples around a tile
const ivec2 kRegion = 2 * kCoarse + 8;   // finer ones that they are made of
const int kRows = THREADS / kCoarse.x;   // of coarse samples at a time
const int kRun = TILE_X * TILE_Y / THREADS;  // pixels of an invocation, one below the other
const int kLoads = (kRegion.x * kRegion.y + THREADS - 1) / THREADS;
shared float region[kRegion.x * kRegion.y];
// What a filtered sample has more than the finer one at its tap 2: what is small beside a band must not be lost
// beside the luminance.
shared float rowExcess[kCoarse.x * kRegion.y];
shared vec2 coarse[kCoarse.x * kCoarse.y];  // a sample near by and the excess over it

// Six weights of a sample `t` right of tap 2.
void weightsOf(float t, out float w[6]) {
  w[0] = run.kernel.x - t * run.kernel.x;
  w[1] = mix(run.kernel.y, run.kernel.x, t);
  w[2] = mix(run.kernel.z, run.kernel.y, t);
  w[3] = mix(run.kernel.y, run.kernel.z, t);
  w[4] = mix(run.kernel.x, run.kernel.y, t);
  w[5] = t * run.kernel.x;
}

// All loads of an invocation are under way before the first is used.
void loadRegion(int thread, ivec2 from, ivec2 fineSize) {
  float values[kLoads];
  for (int k = 0; k < kLoads; ++k) {
    int i = min(thread + k * THREADS, kRegion.x * kRegion.y - 1);
    ivec2 at = ivec2(borderIndex(from.x + i % kRegion.x, fineSize.x),
                     borderIndex(from.y + i / kRegion.x, fineSize.y));
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
}

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

  // Coarse samples around the tile, and the finer samples of those.
  vec2 startX = places[upward[0].x + origin.x], startY = places[upward[0].y + origin.y];
  ivec2 first = ivec2(startX.x, startY.x);
  ivec2 end = ivec2(places[upward[0].x + last.x].x, places[upward[0].y + last.y].x) + 2;
  ivec2 inside = clamp(first, ivec2(0), coarseSize - 1), insideEnd = clamp(end - 1, ivec2(0), coarseSize - 1);
  ivec2 from = ivec2(places[downward[0].x + inside.x].x, places[downward[0].y + inside.y].x) - 2;
  ivec2 to = ivec2(places[downward[0].x + insideEnd.x].x, places[downward[0].y + insideEnd.y].x) + 4;
  ivec2 extent = to - from, count = end - first;

  loadRegion(thread, from, fineSize);
  barrier();

  int column = thread % kCoarse.x, firstRow = thread / kCoarse.x;
  bool works = firstRow < kRows && column < count.x;
  vec2 place = places[downward[0].x + clamp(first.x + column, 0, coarseSize.x - 1)];
  int left = int(place.x) - 2 - from.x;
  if (works) {
    float w[6];
    weightsOf(place.y, w);
    for (int y = firstRow; y < extent.y; y += kRows) {
      int at = y * kRegion.x + left;
      float near = region[at + 2], sum = 0.0;
      for (int tap = 0; tap < 6; ++tap) sum += w[tap] * (region[at + tap] - near);
      rowExcess[y * kCoarse.x + column] = sum;
    }
  }
  barrier();

  // Those whose place on the finer level is in the tile are this group's to write.
  ivec2 ownFirst = first + ivec2(startX.y > 0.0, startY.y > 0.0), ownEnd = coarseSize;
  if (origin.x + kTile.x < fineSize.x) {
    vec2 next = places[upward[0].x + origin.x + kTile.x];
    ownEnd.x = int(next.x) + int(next.y > 0.0);
  }
  if (origin.y + kTile.y < fineSize.y) {
    vec2 next = places[upward[0].y + origin.y + kTile.y];
    ownEnd.y = int(next.x) + int(next.y > 0.0);
  }
  if (works) {
    for (int y = firstRow; y < count.y; y += kRows) {
      ivec2 sampleAt = first + ivec2(column, y);
      vec2 rowPlace = places[downward[0].y + clamp(sampleAt.y, 0, coarseSize.y - 1)];
      int top = int(rowPlace.x) - 2 - from.y;
      float w[6], near = region[(top + 2) * kRegion.x + left + 2], sum = 0.0;
      weightsOf(rowPlace.y, w);
      for (int tap = 0; tap < 6; ++tap)
        sum += w[tap] * ((region[(top + tap) * kRegion.x + left + 2] - near) +
                         rowExcess[(top + tap) * kCoarse.x + column]);
      coarse[y * kCoarse.x + column] = vec2(near, sum);
      if (all(greaterThanEqual(sampleAt, ownFirst)) && all(lessThan(sampleAt, ownEnd)))
        imageStore(coarser, sampleAt, vec4(near + sum));
    }
  }
#if BAND
  barrier();
  int x = origin.x + thread % kTile.x, y = origin.y + thread / kTile.x * kRun;
  if (x >= fineSize.x) return;
  place = places[upward[0].x + x];
  left = int(place.x) - first.x;
  int top = -1000;
  // Two rows of coarse samples, interpolated along x; they move down with the pixel.
  vec2 upper = vec2(0.0), lower = vec2(0.0);
  for (int i = 0; i < kRun && y <= last.y; ++i, ++y) {
    vec2 rowPlace = places[upward[0].y + y];
    int row = int(rowPlace.x) - first.y;
    if (row != top) {
      int at = row * kCoarse.x + left;
      vec2 a = coarse[at], b = coarse[at + 1];
      upper = row == top + 1 ? lower : vec2(a.x, a.y + place.y * ((b.x - a.x) + (b.y - a.y)));
      a = coarse[at + kCoarse.x], b = coarse[at + kCoarse.x + 1];
      lower = vec2(a.x, a.y + place.y * ((b.x - a.x) + (b.y - a.y)));
      top = row;
    }
    float value = region[(y - from.y) * kRegion.x + x - from.x];
    float above = (upper.x - value) + upper.y, below = (lower.x - value) + lower.y;
    float difference = -(above + rowPlace.y * (below - above));
#if BAND == 16
    difference = sign(difference) * sqrt(abs(difference));  // for the range of 16 bits
#endif
    imageStore(band, ivec2(x, y), vec4(difference));
  }
#endif
}
