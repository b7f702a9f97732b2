// SPDX-License-Identifier: BSD-3-Clause
// The last pass: thresholds from band 0 and the coarser levels. Each group makes a tile of the map. It loads the
// samples of all levels around its tile to shared memory and brings them to the tile's columns; each pixel then
// brings them to its row. How a level comes up, directly (pyramid) or by way of the levels between (stack), is in
// the taps: along an axis either is a weighted mean of three samples at most.
#include "perception/threshold_maps/threshold_map_bindings.h"
#include "perception/threshold_maps/common.glsl"
#include "perception/threshold_maps/model.glsl"

layout(local_size_x = THREADS) in;
layout(binding = kEvaluateFinestUnit) uniform sampler2D finest;     // band 0, or (FINEST_LUMINANCE) luminance
layout(binding = kEvaluateGaussianUnit) uniform sampler2D gaussian;   // levels from 1
#if REST
layout(binding = kEvaluateRestUnit) uniform sampler2D rest;  // what rounding took from level 1
#endif
layout(binding = kEvaluateImage, r32f) uniform writeonly image2D threshold;
#if STAGES
layout(binding = kEvaluateStagesImage, rg32f) uniform writeonly image2D stages;
#endif
// For each tile column, then each tile row: first sample and count at each level from 1.
layout(std430, binding = kEvaluatePatchesBuffer) readonly buffer Patches { ivec2 patches[]; };
uniform int tileColumns;
uniform ivec2 firstTile;  // of those that this dispatch evaluates
// For each level from 1 all columns of the map, then likewise all rows: first sample, its weight, the third's;
// the second has the rest.
layout(std430, binding = kEvaluateTapsBuffer) readonly buffer Taps { vec4 taps[]; };
#if MEAN_REMOVED
layout(std430, binding = kThresholdMeanBuffer) readonly buffer Mean { float meanLuminance; };
#else
const float meanLuminance = 0.0;
#endif

const ivec2 kTile = ivec2(TILE_X, TILE_Y);
ivec2 tileNumber() { return firstTile + ivec2(gl_WorkGroupID.xy); }
const int kRun = TILE_X * TILE_Y / THREADS;  // pixels of an invocation, one below the other
const int kPlanes = LEVELS - 1;

// Band 0 of 16 bits is its signed square root; luminance, which is what there is without levels, is stored plainly.
float decoded(float code) {
#if LEVELS > 1 && HALF && !FINEST_LUMINANCE
  return code * abs(code);
#else
  return code;
#endif
}

#if LEVELS > 1
// Most samples around a tile, and where those of a level start in shared memory.
const int kWidth[8] = int[8](LIMEN_MOST_SAMPLE_COLUMNS);
const int kHeight[8] = int[8](LIMEN_MOST_SAMPLE_ROWS);
const int kStart[9] = int[9](0, 720, 960, 1056, 1104, 1134, 1159, 1184, 1209);
const int kFirstRow[9] = int[9](0, 20, 32, 40, 46, 51, 56, 61, 66);
shared float samples[kStart[kPlanes]];
shared ivec4 rowTaps[kPlanes * kTile.y];  // where the first sample is in `rows`, and both weights' bits
shared float rows[kFirstRow[kPlanes] * kTile.x];  // at the tile's columns

ivec2 originOf(int i) {
  return ivec2(patches[tileNumber().x * kPlanes + i - 1].x,
               patches[(tileColumns + tileNumber().y) * kPlanes + i - 1].x);
}
ivec2 countOf(int i) {
  return ivec2(patches[tileNumber().x * kPlanes + i - 1].y,
               patches[(tileColumns + tileNumber().y) * kPlanes + i - 1].y);
}

// A flat field stays flat to the last bit.
float weigh(float first, float second, float third, vec4 tap) {
  return second + tap.y * (first - second) + tap.z * (third - second);
}
#endif

#if REST
// What level 1 has been reduced by in shared memory: interpolated beside the whole luminance, a band that is faint
// beside it would be all rounding error.
float base = 0.0;
#endif

// Contrasts of one pixel, and (return) its adaptation luminance; `gathered`: levels 1 ... there.
float contrastsOf(float finestValue, float gathered[max(kPlanes, 1)], out float c[BANDS + 1]) {
  c[BANDS] = 0.0;
#if LEVELS == 1
  return finestValue + meanLuminance;
#else
#if FINEST_LUMINANCE
#if REST
  float band0 = (finestValue - base) - gathered[0];
  gathered[0] += base;
#else
  float band0 = finestValue - gathered[0];
#endif
  float luminance = finestValue;
#else
  float band0 = finestValue, luminance = finestValue + gathered[0];
#endif
  for (int i = 0; i < BANDS; ++i) {
    float difference = i == 0 ? band0 : gathered[max(i - 1, 0)] - gathered[i];
    c[i] = abs(difference) / max(gathered[i + 1] + meanLuminance, run.light.w) * run.bands[i].y;
  }
  float near = ADAPTATION_LEVEL == 0 ? luminance : gathered[max(ADAPTATION_LEVEL - 1, 0)];
  float far = gathered[min(ADAPTATION_LEVEL, kPlanes - 1)];
  return max(near + meanLuminance + run.rule.x * (far - near), 0.0);
#endif
}

#if LEVELS > 1
// Level 1 has more samples than there are invocations.
const int kFirstSlots = (36 * 20 + THREADS - 1) / THREADS;

void loadTile(int thread, int x, int mapColumns) {
#if REST
  base = texelFetch(gaussian, clamp(originOf(1), ivec2(0), textureSize(gaussian, 0) - 1), 0).r;
#endif
  // All loads are under way before the first is used.
  float loaded[kFirstSlots + kPlanes - 1];
#if REST
  float lost[kFirstSlots];
#endif
  for (int slot = 0; slot < kFirstSlots + kPlanes - 1; ++slot) {
    int i = max(slot - kFirstSlots + 2, 1), p = thread + (slot < kFirstSlots ? slot * THREADS : 0);
    ivec2 at = originOf(i) + ivec2(p % kWidth[i - 1], p / kWidth[i - 1]);
    at = clamp(at, ivec2(0), textureSize(gaussian, i - 1) - 1);
    loaded[slot] = texelFetch(gaussian, at, i - 1).r;
#if REST
    if (slot < kFirstSlots) lost[slot] = texelFetch(rest, at, 0).r;
#endif
  }
  vec4 columnTaps[kPlanes];
  for (int plane = 0; plane < kPlanes; ++plane) columnTaps[plane] = taps[plane * mapColumns + x];
  for (int slot = 0; slot < kFirstSlots + kPlanes - 1; ++slot) {
    int i = max(slot - kFirstSlots + 2, 1), p = thread + (slot < kFirstSlots ? slot * THREADS : 0);
    float value = loaded[slot];
#if REST
    if (slot < kFirstSlots) value = (value - base) + value * (lost[slot] / kRestScale);
#endif
    if (p < kStart[i] - kStart[i - 1]) samples[kStart[i - 1] + p] = value;
  }
  for (int i = thread; i < kPlanes * kTile.y; i += THREADS) {
    int plane = i / kTile.y, mapRows = imageSize(threshold).y;
    int y = min(tileNumber().y * kTile.y + i % kTile.y, mapRows - 1);
    vec4 tap = taps[kPlanes * mapColumns + plane * mapRows + y];
    int row = kFirstRow[plane] + int(tap.x) - originOf(plane + 1).y;
    rowTaps[i] = ivec4(row * kTile.x, floatBitsToInt(tap.yz), 0);
  }
  barrier();
  for (int plane = 0; plane < kPlanes; ++plane) {
    int q = kStart[plane] + int(columnTaps[plane].x) - originOf(plane + 1).x, count = countOf(plane + 1).y;
    for (int row = thread / kTile.x; row < count; row += THREADS / kTile.x) {
      int at = q + row * kWidth[plane];
      rows[(kFirstRow[plane] + row) * kTile.x + thread % kTile.x] =
          weigh(samples[at], samples[at + 1], samples[at + 2], columnTaps[plane]);
    }
  }
  barrier();
}
#endif

void main() {
  int thread = int(gl_LocalInvocationIndex);
  ivec2 size = imageSize(threshold), tile = tileNumber() * kTile;
  ivec2 first = tile + ivec2(thread % kTile.x, thread / kTile.x * kRun);
  int x = min(first.x, size.x - 1);
  float finestValues[kRun];
  for (int i = 0; i < kRun; ++i)
    finestValues[i] = decoded(texelFetch(finest, ivec2(x, min(first.y + i, size.y - 1)), 0).r);
  float contrasts[kRun][BANDS + 1], adaptation[kRun];
#if LEVELS == 1
  for (int i = 0; i < kRun; ++i)
    adaptation[i] = contrastsOf(finestValues[i], float[1](0.0), contrasts[i]);
#else
  loadTile(thread, x, size.x);
  int column = thread % kTile.x, row = thread / kTile.x * kRun;
  for (int i = 0; i < kRun; ++i) {
    float gathered[kPlanes];
    for (int plane = 0; plane < kPlanes; ++plane) {
      ivec4 tap = rowTaps[plane * kTile.y + row + i];
      int q = tap.x + column;
      gathered[plane] = weigh(rows[q], rows[q + kTile.x], rows[q + 2 * kTile.x], intBitsToFloat(tap));
    }
    adaptation[i] = contrastsOf(finestValues[i], gathered, contrasts[i]);
  }
#endif
  for (int i = 0; i < kRun; ++i) {
    ivec2 at = first + ivec2(0, i);
    vec2 evaluated = evaluate(contrasts[i], adaptation[i]);
    // Beyond the map nothing is stored.
    imageStore(threshold, at, vec4(run.rule.z * evaluated.y * evaluated.x));
#if STAGES
    imageStore(stages, at, vec4(adaptation[i], evaluated.x, 0.0, 0.0));
#endif
  }
}
