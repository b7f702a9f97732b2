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
uniform ivec2 upward;    // first entries in Places, columns and rows: finer samples on the coarser level
uniform ivec2 downward;  // coarser samples on the finer level

const ivec2 kTile = ivec2(64, 32);
const ivec2 kCoarse = ivec2(34, 18);  // samples around a tile
const ivec2 kRegion = ivec2(76, 44);  // finer ones that they are made of
const int kRows = 256 / kCoarse.x;    // of coarse samples at a time
const int kRun = 8;                   // pixels of an invocation, one below the other
shared float region[kRegion.x * kRegion.y];
// As a sample near by and what to add: what is small beside a band must not be lost beside the luminance.
shared vec2 filteredRows[kCoarse.x * kRegion.y];
shared vec2 coarse[kCoarse.x * kCoarse.y];

// Six weights of a sample `t` right of tap 2.
void weightsOf(float t, out float w[6]) {
  w[0] = run.kernel.x - t * run.kernel.x;
  w[1] = mix(run.kernel.y, run.kernel.x, t);
  w[2] = mix(run.kernel.z, run.kernel.y, t);
  w[3] = mix(run.kernel.y, run.kernel.z, t);
  w[4] = mix(run.kernel.x, run.kernel.y, t);
  w[5] = t * run.kernel.x;
}

void loadRegion(int thread, ivec2 from, ivec2 extent, ivec2 fineSize) {
  const int kColumns = (kRegion.x + 31) / 32;
  int lane = thread % 32, columns[kColumns];
  for (int k = 0; k < kColumns; ++k) columns[k] = borderIndex(from.x + lane + 32 * k, fineSize.x);
  for (int y = thread / 32; y < extent.y; y += 8) {
    int row = borderIndex(from.y + y, fineSize.y);
    for (int k = 0; k < kColumns; ++k) {
      int x = lane + 32 * k;
      if (x >= extent.x) break;
#if FROM_LEVEL
      region[y * kRegion.x + x] = texelFetch(source, ivec2(columns[k], row), sourceLevel).r;
#else
      region[y * kRegion.x + x] = luminanceOf(texelFetch(source, ivec2(columns[k], row), 0));
#endif
    }
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
  vec2 startX = places[upward.x + origin.x], startY = places[upward.y + origin.y];
  ivec2 first = ivec2(startX.x, startY.x);
  ivec2 end = ivec2(places[upward.x + last.x].x, places[upward.y + last.y].x) + 2;
  ivec2 inside = clamp(first, ivec2(0), coarseSize - 1), insideEnd = clamp(end - 1, ivec2(0), coarseSize - 1);
  ivec2 from = ivec2(places[downward.x + inside.x].x, places[downward.y + inside.y].x) - 2;
  ivec2 to = ivec2(places[downward.x + insideEnd.x].x, places[downward.y + insideEnd.y].x) + 4;
  ivec2 extent = to - from, count = end - first;

  loadRegion(thread, from, extent, fineSize);
  barrier();

  int column = thread % kCoarse.x, firstRow = thread / kCoarse.x;
  bool works = firstRow < kRows && column < count.x;
  if (works) {
    vec2 place = places[downward.x + clamp(first.x + column, 0, coarseSize.x - 1)];
    int left = int(place.x) - 2 - from.x;
    float w[6];
    weightsOf(place.y, w);
    for (int y = firstRow; y < extent.y; y += kRows) {
      int at = y * kRegion.x + left;
      float near = region[at + 2], sum = 0.0;
      for (int tap = 0; tap < 6; ++tap) sum += w[tap] * (region[at + tap] - near);
      filteredRows[y * kCoarse.x + column] = vec2(near, sum);
    }
  }
  barrier();

  // Those whose place on the finer level is in the tile are this group's to write.
  ivec2 ownFirst = first + ivec2(startX.y > 0.0, startY.y > 0.0), ownEnd = coarseSize;
  if (origin.x + kTile.x < fineSize.x) {
    vec2 next = places[upward.x + origin.x + kTile.x];
    ownEnd.x = int(next.x) + int(next.y > 0.0);
  }
  if (origin.y + kTile.y < fineSize.y) {
    vec2 next = places[upward.y + origin.y + kTile.y];
    ownEnd.y = int(next.x) + int(next.y > 0.0);
  }
  if (works) {
    for (int y = firstRow; y < count.y; y += kRows) {
      ivec2 sampleAt = first + ivec2(column, y);
      vec2 place = places[downward.y + clamp(sampleAt.y, 0, coarseSize.y - 1)];
      int at = (int(place.x) - 2 - from.y) * kCoarse.x + column;
      float w[6], near = filteredRows[at + 2 * kCoarse.x].x, sum = 0.0;
      weightsOf(place.y, w);
      for (int tap = 0; tap < 6; ++tap) {
        vec2 v = filteredRows[at + tap * kCoarse.x];
        sum += w[tap] * ((v.x - near) + v.y);
      }
      coarse[y * kCoarse.x + column] = vec2(near, sum);
      if (all(greaterThanEqual(sampleAt, ownFirst)) && all(lessThan(sampleAt, ownEnd)))
        imageStore(coarser, sampleAt, vec4(near + sum));
    }
  }
#if BAND
  barrier();
  int x = origin.x + thread % kTile.x, y = origin.y + thread / kTile.x * kRun;
  if (x >= fineSize.x) return;
  vec2 place = places[upward.x + x];
  int left = int(place.x) - first.x, top = -1000;
  // Two rows of coarse samples, interpolated along x; they move down with the pixel.
  vec2 upper = vec2(0.0), lower = vec2(0.0);
  for (int i = 0; i < kRun && y <= last.y; ++i, ++y) {
    vec2 rowPlace = places[upward.y + y];
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
