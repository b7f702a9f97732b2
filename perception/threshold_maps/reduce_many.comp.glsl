// SPDX-License-Identifier: BSD-3-Clause
// STEPS levels of the pyramid at once, for levels so small that starting a pass costs more than the pass. Each
// group takes a tile of the source level and makes what lies in it on the next levels; what it needs beyond
// its tile it makes too, so that groups need not wait for one another. Numbers are those of reduce.comp.glsl.
#include "perception/threshold_maps/threshold_map_bindings.h"
#include "perception/threshold_maps/common.glsl"

layout(local_size_x = THREADS) in;
layout(binding = kCoarsenSourceUnit) uniform sampler2D source;
layout(binding = kCoarsenCoarserImage, r32f) uniform writeonly image2D coarser1;
#if STEPS > 1
layout(binding = kCoarsenManyCoarser2Image, r32f) uniform writeonly image2D coarser2;
#endif
#if STEPS > 2
layout(binding = kCoarsenManyCoarser3Image, r32f) uniform writeonly image2D coarser3;
#endif
uniform int sourceLevel;
uniform ivec2 downward[STEPS];  // first entries in Places: coarser samples on the finer level, by step

const ivec2 kTile = ivec2(TILE_X, TILE_Y);
// Most samples of the next levels that a tile needs: 2 n + 5 of each finer one.
const ivec2 kMost1 = ivec2(51, 35), kMost2 = ivec2(23, 15);
shared float filteredRows[kMost1.x * (2 * kMost1.y + 5)];
shared float level1[kMost1.x * kMost1.y];
shared float level2[kMost2.x * kMost2.y];

struct Range {  // [first, end)
  ivec2 first, end;
};

float weightOf(int tap, float t) {
  float taps[7] = float[7](0.0, run.kernel.x, run.kernel.y, run.kernel.z, run.kernel.y, run.kernel.x, 0.0);
  return mix(taps[tap + 1], taps[tap], t);
}

ivec2 sizeOf(int step) { return max(textureSize(source, 0) >> (sourceLevel + step), ivec2(1)); }

// Samples of the next level whose places lie in a range of this one.
Range ownOf(Range fine, ivec2 fineSize, ivec2 coarseSize) {
  Range own;
  for (int axis = 0; axis < 2; ++axis) {
    int left;
    float t;
    place(fine.first[axis], coarseSize[axis], fineSize[axis], left, t);
    own.first[axis] = left + (t > 0.0 ? 1 : 0);
    place(fine.end[axis], coarseSize[axis], fineSize[axis], left, t);
    own.end[axis] = fine.end[axis] >= fineSize[axis] ? coarseSize[axis] : left + (t > 0.0 ? 1 : 0);
  }
  return own;
}

// Samples of this level that a range of the next one is made of.
Range neededFor(Range coarse, ivec2 coarseSize, ivec2 fineSize) {
  Range fine;
  for (int axis = 0; axis < 2; ++axis) {
    int left;
    float t;
    place(coarse.first[axis], fineSize[axis], coarseSize[axis], left, t);
    fine.first[axis] = max(left - 2, 0);
    place(coarse.end[axis] - 1, fineSize[axis], coarseSize[axis], left, t);
    fine.end[axis] = min(left + 4, fineSize[axis]);
  }
  return fine;
}

bool isEmpty(Range range) { return any(lessThanEqual(range.end, range.first)); }

// Where the next level is written that is made of `fine`.
void store(int step, ivec2 at, float value) {
  if (step == 1) imageStore(coarser1, at, vec4(value));
#if STEPS > 1
  if (step == 2) imageStore(coarser2, at, vec4(value));
#endif
#if STEPS > 2
  if (step == 3) imageStore(coarser3, at, vec4(value));
#endif
}

float fineValue(int step, ivec2 at, Range fine) {
  if (step == 1) return texelFetch(source, at, sourceLevel).r;
  ivec2 i = at - fine.first;
  return step == 2 ? level1[i.y * kMost1.x + i.x] : level2[i.y * kMost2.x + i.x];
}

void main() {
  int thread = int(gl_LocalInvocationIndex);
  ivec2 sizes[STEPS + 1];
  Range own[STEPS + 1], needed[STEPS + 1];
  for (int step = 0; step <= STEPS; ++step) sizes[step] = sizeOf(step);
  own[0].first = ivec2(gl_WorkGroupID.xy) * kTile;
  own[0].end = min(own[0].first + kTile, sizes[0]);
  for (int step = 1; step <= STEPS; ++step) own[step] = ownOf(own[step - 1], sizes[step - 1], sizes[step]);
  for (int step = STEPS; step >= 0; --step) {
    needed[step] = own[step];
    if (step == STEPS || isEmpty(needed[step + 1])) continue;
    Range more = neededFor(needed[step + 1], sizes[step + 1], sizes[step]);
    bool none = isEmpty(own[step]) || step == 0;
    needed[step].first = none ? more.first : min(own[step].first, more.first);
    needed[step].end = none ? more.end : max(own[step].end, more.end);
  }

  for (int step = 1; step <= STEPS; ++step) {
    if (isEmpty(needed[step])) break;  // the same for all of the group
    Range fine = needed[step - 1], coarse = needed[step];
    ivec2 fineSize = sizes[step - 1], coarseSize = sizes[step];
    Range rows = neededFor(coarse, coarseSize, fineSize);
    ivec2 count = coarse.end - coarse.first;
    int rowCount = rows.end.y - rows.first.y;
    for (int i = thread; i < count.x * rowCount; i += THREADS) {
      int x = i % count.x, y = rows.first.y + i / count.x;
      vec2 at = places[downward[step - 1].x + coarse.first.x + x];
      int left = int(at.x);
      float t = at.y;
      float middle = fineValue(step, ivec2(borderIndex(left, fineSize.x), y), fine), sum = 0.0;
      for (int tap = 0; tap < 6; ++tap)
        sum += weightOf(tap, t) *
               (fineValue(step, ivec2(borderIndex(left - 2 + tap, fineSize.x), y), fine) - middle);
      filteredRows[(y - rows.first.y) * kMost1.x + x] = middle + sum;
    }
    barrier();
    for (int i = thread; i < count.x * count.y; i += THREADS) {
      ivec2 at = ivec2(i % count.x, i / count.x), sampleAt = coarse.first + at;
      vec2 placed = places[downward[step - 1].y + sampleAt.y];
      int left = int(placed.x);
      float t = placed.y;
      float middle = filteredRows[(borderIndex(left, fineSize.y) - rows.first.y) * kMost1.x + at.x], sum = 0.0;
      for (int tap = 0; tap < 6; ++tap) {
        int row = borderIndex(left - 2 + tap, fineSize.y) - rows.first.y;
        sum += weightOf(tap, t) * (filteredRows[row * kMost1.x + at.x] - middle);
      }
      float value = middle + sum;
      if (step == 1) level1[at.y * kMost1.x + at.x] = value;
      if (step == 2) level2[at.y * kMost2.x + at.x] = value;
      if (all(greaterThanEqual(sampleAt, own[step].first)) && all(lessThan(sampleAt, own[step].end)))
        store(step, sampleAt, value);
    }
    barrier();
  }
}
