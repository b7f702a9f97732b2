// SPDX-License-Identifier: BSD-3-Clause
// The last pass: thresholds from band 0 and the coarser levels. Each group makes a tile of the map. It loads
// the coarser samples around its tile to shared memory; for a stack it brings them up there, one level at a time,
// to level 1, so that the stack exists for a tile only. Band 0 is all that a pixel is
// read for; in 16 bits (HALF) it is stored as a signed square root.
#include "perception/threshold_maps/common.glsl"
#include "perception/threshold_maps/model.glsl"

layout(local_size_x = THREADS) in;
layout(binding = 0) uniform sampler2D finest;     // band 0, or (FINEST_LUMINANCE) luminance
layout(binding = 1) uniform sampler2D gaussian;   // levels from 1
layout(binding = 0, r32f) uniform writeonly image2D threshold;
#if STAGES
layout(binding = 1, rg32f) uniform writeonly image2D stages;
#endif
// For each tile column, then each tile row: first sample and count at each level from 1.
layout(std430, binding = 1) readonly buffer Patches { ivec2 patches[]; };
uniform int tileColumns;
uniform ivec2 upward[max(LEVELS - 1, 1)];  // first entries in Places of level i on level i + 1: columns, rows

const ivec2 kTile = ivec2(TILE_X, TILE_Y);
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
// Most samples around a tile at levels 1, 2 ...
const int kWidth[8] = int[8](34, 19, 11, 7, 5, 4, 4, 4);
const int kHeight[8] = int[8](18, 11, 7, 5, 4, 4, 4, 4);
#if STACK
const int kPlaneSize = 34 * 18, kCoarserPlaneSize = 19 * 11;
shared float atOdd[kPlanes * kPlaneSize];                      // planes at level 1, 3, 5 ...
shared float atEven[max(kPlanes - 1, 1) * kCoarserPlaneSize];  // at level 2, 4 ...
#else
// One behind the other; shared memory for all that there may be.
const int kStart[8] = int[8](0, 612, 821, 898, 933, 953, 969, 985);
shared float level[1001];
shared int rowLeft[kPlanes * kTile.y], columnLeft[kPlanes * kTile.x];
shared float rowRest[kPlanes * kTile.y], columnRest[kPlanes * kTile.x];
#endif

ivec2 originOf(int i) {
  return ivec2(patches[int(gl_WorkGroupID.x) * kPlanes + i - 1].x,
               patches[(tileColumns + int(gl_WorkGroupID.y)) * kPlanes + i - 1].x);
}
ivec2 countOf(int i) {
  return ivec2(patches[int(gl_WorkGroupID.x) * kPlanes + i - 1].y,
               patches[(tileColumns + int(gl_WorkGroupID.y)) * kPlanes + i - 1].y);
}

float between(float a, float b, float c, float d, vec2 t) {
  float upper = a + t.x * (b - a), lower = c + t.x * (d - c);
  return upper + t.y * (lower - upper);
}
#endif

// Contrasts of one pixel, and (return) its adaptation luminance; `gathered`: levels 1 ... there.
float contrastsOf(float finestValue, float gathered[max(kPlanes, 1)], out float c[BANDS + 1]) {
  c[BANDS] = 0.0;
#if LEVELS == 1
  return finestValue;
#else
#if FINEST_LUMINANCE
  float band0 = finestValue - gathered[0], luminance = finestValue;
#else
  float band0 = finestValue, luminance = finestValue + gathered[0];
#endif
  for (int i = 0; i < BANDS; ++i) {
    float difference = i == 0 ? band0 : gathered[max(i - 1, 0)] - gathered[i];
    c[i] = abs(difference) / max(gathered[i + 1], run.light.w) * run.bands[i].y;
  }
  float near = ADAPTATION_LEVEL == 0 ? luminance : gathered[max(ADAPTATION_LEVEL - 1, 0)];
  float far = gathered[min(ADAPTATION_LEVEL, kPlanes - 1)];
  return max(near + run.rule.x * (far - near), 0.0);
#endif
}

#if LEVELS > 1
#if STACK
// Slot 0 and on of an invocation's samples: level 1 has more of them than there are invocations.
const int kFirstSlots = (34 * 18 + THREADS - 1) / THREADS;
const int kSlots = kFirstSlots + kPlanes - 1;
int levelOf(int slot) { return max(slot - kFirstSlots + 2, 1); }

void loadStack(int thread) {
  // All samples and where they lie on the coarser level are under way before the first is used.
  float own[kSlots];
  vec2 t[kSlots];
  int from[kSlots], to[kSlots];  // -1: no sample
  for (int slot = 0; slot < kSlots; ++slot) {
    int i = levelOf(slot), p = thread + (slot < kFirstSlots ? slot * THREADS : 0), stride = kWidth[i - 1];
    ivec2 at = ivec2(p % stride, p / stride), origin = originOf(i);
    to[slot] = all(lessThan(at, countOf(i))) ? p : -1;
    ivec2 sampleAt = clamp(origin + at, ivec2(0), textureSize(gaussian, i - 1) - 1);
    own[slot] = texelFetch(gaussian, sampleAt, i - 1).r;
    t[slot] = vec2(0.0);
    from[slot] = 0;
    if (i < kPlanes) {
      vec2 placeX = places[upward[i].x + sampleAt.x], placeY = places[upward[i].y + sampleAt.y];
      ivec2 below = originOf(i + 1);
      t[slot] = vec2(placeX.y, placeY.y);
      from[slot] = (int(placeY.x) - below.y) * kWidth[i] + int(placeX.x) - below.x;
    }
  }
  // From level i + 1 to level i; plane 0 is the coarsest level, the finer ones follow.
  for (int i = kPlanes; i >= 1; --i) {
    const int stride = kWidth[min(i, 7)];
    int planes = kPlanes - i;
    for (int slot = (i == 1 ? 0 : kFirstSlots + i - 2); slot <= kFirstSlots + i - 2; ++slot) {
      int p = to[slot], q = from[slot];
      if (p < 0) continue;
      for (int plane = 0; plane < planes; ++plane) {
        if (i % 2 == 1) {
          atOdd[plane * kPlaneSize + p] =
              between(atEven[q], atEven[q + 1], atEven[q + stride], atEven[q + stride + 1], t[slot]);
          q += kCoarserPlaneSize;
        } else {
          atEven[plane * kCoarserPlaneSize + p] =
              between(atOdd[q], atOdd[q + 1], atOdd[q + stride], atOdd[q + stride + 1], t[slot]);
          q += kPlaneSize;
        }
      }
      if (i % 2 == 1)
        atOdd[planes * kPlaneSize + p] = own[slot];
      else
        atEven[planes * kCoarserPlaneSize + p] = own[slot];
    }
    barrier();
  }
}
#else
void loadPyramid(int thread, ivec2 tile, ivec2 fullSize) {
  for (int i = 1; i <= kPlanes; ++i) {
    ivec2 origin = originOf(i), count = countOf(i), size = textureSize(gaussian, i - 1);
    int stride = kWidth[i - 1];
    for (int p = thread; p < stride * count.y; p += THREADS) {
      ivec2 at = ivec2(p % stride, p / stride);
      if (at.x >= count.x) continue;
      ivec2 sampleAt = clamp(origin + at, ivec2(0), size - 1);
      level[kStart[i - 1] + p] = texelFetch(gaussian, sampleAt, i - 1).r;
    }
  }
  for (int i = thread; i < kPlanes * kTile.y; i += THREADS) {
    int plane = i / kTile.y, y = min(tile.y + i % kTile.y, fullSize.y - 1), left;
    float t;
    place(y, textureSize(gaussian, plane).y, fullSize.y, left, t);
    rowLeft[i] = left - originOf(plane + 1).y;
    rowRest[i] = t;
  }
  for (int i = thread; i < kPlanes * kTile.x; i += THREADS) {
    int plane = i / kTile.x, x = min(tile.x + i % kTile.x, fullSize.x - 1), left;
    float t;
    place(x, textureSize(gaussian, plane).x, fullSize.x, left, t);
    columnLeft[i] = left - originOf(plane + 1).x;
    columnRest[i] = t;
  }
  barrier();
}
#endif
#endif

void main() {
  int thread = int(gl_LocalInvocationIndex);
  ivec2 size = imageSize(threshold), tile = ivec2(gl_WorkGroupID.xy) * kTile;
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
  // Two rows of samples around the pixel, interpolated along x; they move down with the pixel.
  float upper[kPlanes], lower[kPlanes], gathered[kPlanes];
#if STACK
  vec2 placeX = places[upward[0].x + x], placeY[kRun];
  for (int i = 0; i < kRun; ++i) placeY[i] = places[upward[0].y + min(first.y + i, size.y - 1)];
  loadStack(thread);
  ivec2 origin = originOf(1);
  int left = int(placeX.x) - origin.x, row = -1000;
  for (int i = 0; i < kRun; ++i) {
    int top = int(placeY[i].x) - origin.y;
    if (top != row) {
      bool moved = top == row + 1;
      row = top;
      for (int plane = 0; plane < kPlanes; ++plane) {
        // Planes lie coarsest first.
        int q = (kPlanes - 1 - plane) * kPlaneSize + top * kWidth[0] + left;
        upper[plane] = moved ? lower[plane] : atOdd[q] + placeX.y * (atOdd[q + 1] - atOdd[q]);
        q += kWidth[0];
        lower[plane] = atOdd[q] + placeX.y * (atOdd[q + 1] - atOdd[q]);
      }
    }
    for (int plane = 0; plane < kPlanes; ++plane)
      gathered[plane] = upper[plane] + placeY[i].y * (lower[plane] - upper[plane]);
    adaptation[i] = contrastsOf(finestValues[i], gathered, contrasts[i]);
  }
#else
  loadPyramid(thread, tile, size);
  int column[kPlanes], row[kPlanes];
  float tx[kPlanes];
  for (int plane = 0; plane < kPlanes; ++plane) {
    int entry = plane * kTile.x + thread % kTile.x;
    tx[plane] = columnRest[entry];
    column[plane] = kStart[plane] + columnLeft[entry];
    row[plane] = -1000;
  }
  for (int i = 0; i < kRun; ++i) {
    for (int plane = 0; plane < kPlanes; ++plane) {
      int entry = plane * kTile.y + first.y - tile.y + i, top = rowLeft[entry];
      if (top != row[plane]) {
        int q = column[plane] + top * kWidth[plane];
        upper[plane] = top == row[plane] + 1 ? lower[plane] : level[q] + tx[plane] * (level[q + 1] - level[q]);
        q += kWidth[plane];
        lower[plane] = level[q] + tx[plane] * (level[q + 1] - level[q]);
        row[plane] = top;
      }
      gathered[plane] = upper[plane] + rowRest[entry] * (lower[plane] - upper[plane]);
    }
    adaptation[i] = contrastsOf(finestValues[i], gathered, contrasts[i]);
  }
#endif
#endif
  for (int i = 0; i < kRun; ++i) {
    ivec2 at = first + ivec2(0, i);
    vec2 judged = judge(contrasts[i], adaptation[i]);
    if (any(greaterThanEqual(at, size))) continue;
    imageStore(threshold, at, vec4(run.rule.z * judged.y * judged.x));
#if STAGES
    imageStore(stages, at, vec4(adaptation[i], judged.x, 0.0, 0.0));
#endif
  }
}
