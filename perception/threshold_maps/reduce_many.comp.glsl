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

// Ranges are [first, end), in xy and zw. Functions return once: NVIDIA's compiler makes a loop of each that returns in
// several places, and how long one invocation takes is how long such a small pass takes.

// Where samples of an axis lie on that of another level, as in place(): the sample at or before them, and the first
// that is not before them.
void placesOf(ivec4 x, ivec4 from, ivec4 to, out ivec4 before, out ivec4 notBefore) {
  ivec4 n = (2 * x + 1) * from - to, d = 2 * to;
  before = ivec4(floor(vec4(n) / vec4(d)));
  ivec4 rest = n - before * d;
  ivec4 correction = ivec4(greaterThanEqual(rest, d)) - ivec4(lessThan(rest, ivec4(0)));
  before += correction;
  notBefore = before + ivec4(greaterThan(rest - correction * d, ivec4(0)));
}

bool isEmpty(ivec4 range) { return range.z <= range.x || range.w <= range.y; }

// Samples of the next level whose places lie in a range of this one.
ivec4 ownOf(ivec4 fine, ivec2 fineSize, ivec2 coarseSize) {
  ivec4 before, notBefore;
  placesOf(fine, coarseSize.xyxy, fineSize.xyxy, before, notBefore);
  return ivec4(notBefore.xy, mix(notBefore.zw, coarseSize, greaterThanEqual(fine.zw, fineSize)));
}

// Samples of this level that a range of the next one is made of.
ivec4 neededFor(ivec4 coarse, ivec2 coarseSize, ivec2 fineSize) {
  ivec4 before, notBefore;
  placesOf(coarse - ivec4(0, 0, 1, 1), fineSize.xyxy, coarseSize.xyxy, before, notBefore);
  return ivec4(max(before.xy - 2, ivec2(0)), min(before.zw + 4, fineSize));
}

// What a group writes of a level and what it needs of it for the next one.
ivec4 joined(ivec4 own, ivec4 more) {
  ivec4 both = ivec4(min(own.xy, more.xy), max(own.zw, more.zw));
  return isEmpty(own) ? more : both;
}

void weightsOf(float t, out float w[6]) {
  w[0] = run.kernel.x - t * run.kernel.x;
  w[1] = mix(run.kernel.y, run.kernel.x, t);
  w[2] = mix(run.kernel.z, run.kernel.y, t);
  w[3] = mix(run.kernel.y, run.kernel.z, t);
  w[4] = mix(run.kernel.x, run.kernel.y, t);
  w[5] = t * run.kernel.x;
}

// A sample of the level that a step starts from; `fine`: the range that is in shared memory.
float fineValue(const int step, ivec2 at, ivec4 fine) {
  float value = 0.0;
  ivec2 i = at - fine.xy;
  if (step == 1) value = texelFetch(source, at, sourceLevel).r;
  if (step == 2) value = level1[i.y * kMost1.x + i.x];
  if (step == 3) value = level2[i.y * kMost2.x + i.x];
  return value;
}

// One step: from the samples `fine` of its level those `coarse` of the next. `places0`: first entries in Places;
// `rows`: what the coarse ones are made of; `own`: those that this group writes.
void makeLevel(const int step, ivec2 places0, ivec4 fine, ivec4 rows, ivec4 coarse, ivec4 own, ivec2 fineSize) {
  int thread = int(gl_LocalInvocationIndex);
  ivec2 count = coarse.zw - coarse.xy;
  int rowCount = rows.w - rows.y;
  float w[6];
  for (int i = thread; i < count.x * rowCount; i += THREADS) {
    int x = i % count.x, y = rows.y + i / count.x;
    vec2 at = places[places0.x + coarse.x + x];
    int left = int(at.x);
    weightsOf(at.y, w);
    float middle = fineValue(step, ivec2(borderIndex(left, fineSize.x), y), fine), sum = 0.0;
    for (int tap = 0; tap < 6; ++tap)
      sum += w[tap] * (fineValue(step, ivec2(borderIndex(left - 2 + tap, fineSize.x), y), fine) - middle);
    filteredRows[(y - rows.y) * kMost1.x + x] = middle + sum;
  }
  barrier();
  for (int i = thread; i < count.x * count.y; i += THREADS) {
    ivec2 at = ivec2(i % count.x, i / count.x), sampleAt = coarse.xy + at;
    vec2 placed = places[places0.y + sampleAt.y];
    int left = int(placed.x);
    weightsOf(placed.y, w);
    float middle = filteredRows[(borderIndex(left, fineSize.y) - rows.y) * kMost1.x + at.x], sum = 0.0;
    for (int tap = 0; tap < 6; ++tap)
      sum += w[tap] *
             (filteredRows[(borderIndex(left - 2 + tap, fineSize.y) - rows.y) * kMost1.x + at.x] - middle);
    float value = middle + sum;
    if (step == 1) level1[at.y * kMost1.x + at.x] = value;
    if (step == 2) level2[at.y * kMost2.x + at.x] = value;
    if (all(greaterThanEqual(sampleAt, own.xy)) && all(lessThan(sampleAt, own.zw))) {
      if (step == 1) imageStore(coarser1, sampleAt, vec4(value));
#if STEPS > 1
      if (step == 2) imageStore(coarser2, sampleAt, vec4(value));
#endif
#if STEPS > 2
      if (step == 3) imageStore(coarser3, sampleAt, vec4(value));
#endif
    }
  }
  barrier();
}

void main() {
  ivec2 size0 = max(textureSize(source, 0) >> sourceLevel, ivec2(1)), size1 = max(size0 >> 1, ivec2(1));
  ivec4 own0 = ivec4(ivec2(gl_WorkGroupID.xy) * kTile, 0, 0);
  own0.zw = min(own0.xy + kTile, size0);
  ivec4 own1 = ownOf(own0, size0, size1), needed1 = own1;
#if STEPS > 1
  ivec2 size2 = max(size1 >> 1, ivec2(1));
  ivec4 own2 = ownOf(own1, size1, size2), needed2 = own2;
#endif
#if STEPS > 2
  ivec2 size3 = max(size2 >> 1, ivec2(1));
  ivec4 own3 = ownOf(own2, size2, size3), rows2 = neededFor(own3, size3, size2);
  if (!isEmpty(own3)) needed2 = joined(own2, rows2);
#endif
#if STEPS > 1
  ivec4 rows1 = neededFor(needed2, size2, size1);
  if (!isEmpty(needed2)) needed1 = joined(own1, rows1);
#endif
  ivec4 rows0 = neededFor(needed1, size1, size0);
  // Conditions are the same for all of the group.
  if (!isEmpty(needed1)) {
    makeLevel(1, downward[0], rows0, rows0, needed1, own1, size0);
#if STEPS > 1
    if (!isEmpty(needed2)) {
      makeLevel(2, downward[1], needed1, rows1, needed2, own2, size1);
#if STEPS > 2
      if (!isEmpty(own3)) makeLevel(3, downward[2], needed2, rows2, own3, own3, size2);
#endif
    }
#endif
  }
}
