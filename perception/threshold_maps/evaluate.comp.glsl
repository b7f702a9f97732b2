// SPDX-License-Identifier: BSD-3-Clause
// The last pass: thresholds from band 0 and the coarser levels. Each group makes a tile of the map. It loads
// the coarser samples around its tile to shared memory; for a stack it brings them up there, one level at a time,
// to level 1, so that the stack exists for a tile only. In 16 bits (LAPLACIAN) the first HALF_LEVELS levels are
// stored as bands, which are added up first: what is small is then stored with its own precision.
#include "perception/threshold_maps/common.glsl"
#include "perception/threshold_maps/model.glsl"

layout(local_size_x = 256) in;
layout(binding = 0) uniform sampler2D finest;     // band 0, or (FINEST_LUMINANCE) luminance
layout(binding = 1) uniform sampler2D gaussian;   // levels from 1
layout(binding = 2) uniform sampler2D laplacian;  // bands from 1
layout(binding = 0, r32f) uniform writeonly image2D threshold;
#if STAGES
layout(binding = 1, rg32f) uniform writeonly image2D stages;
#endif
// For each tile column, then each tile row: first sample and count at each level from 1.
layout(std430, binding = 1) readonly buffer Patches { ivec2 patches[]; };
uniform int tileColumns;

const ivec2 kTile = ivec2(64, 32);
const int kRun = 8;  // pixels of an invocation, one below the other
const int kPlanes = LEVELS - 1;

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
shared int rowLeft[kPlanes * kTile.y];
shared float rowRest[kPlanes * kTile.y];
#endif

ivec2 originOf(int i) {
  return ivec2(patches[int(gl_WorkGroupID.x) * kPlanes + i - 1].x,
               patches[(tileColumns + int(gl_WorkGroupID.y)) * kPlanes + i - 1].x);
}
ivec2 countOf(int i) {
  return ivec2(patches[int(gl_WorkGroupID.x) * kPlanes + i - 1].y,
               patches[(tileColumns + int(gl_WorkGroupID.y)) * kPlanes + i - 1].y);
}

// Bands in 16 bits are stored as their signed square root.
float decoded(float code) {
#if LAPLACIAN
  return code * abs(code);
#else
  return code;
#endif
}

// Stored value of level i at a sample: the level itself, or (LAPLACIAN) its band.
float stored(int i, ivec2 at) {
#if LAPLACIAN
  if (i <= HALF_LEVELS) return decoded(texelFetch(laplacian, at, i - 1).r);
#endif
  return texelFetch(gaussian, at, i - 1).r;
}

float between(float a, float b, float c, float d, vec2 t) {
  float upper = a + t.x * (b - a), lower = c + t.x * (d - c);
  return upper + t.y * (lower - upper);
}
#endif

// Threshold of one pixel; `gathered`: levels 1 ... there.
void finish(ivec2 at, float finestValue, float gathered[max(kPlanes, 1)]) {
  float c[BANDS + 1];
  c[BANDS] = 0.0;
#if LEVELS == 1
  float adaptation = finestValue;
#else
#if FINEST_LUMINANCE
  float band0 = finestValue - gathered[0], luminance = finestValue;
#else
  float band0 = finestValue, luminance = finestValue + gathered[0];
#endif
  float near = ADAPTATION_LEVEL == 0 ? luminance : gathered[max(ADAPTATION_LEVEL - 1, 0)];
  float far = gathered[min(ADAPTATION_LEVEL, kPlanes - 1)];
  float adaptation = max(near + run.rule.x * (far - near), 0.0);
  for (int i = 0; i < BANDS; ++i) {
    float difference = i == 0 ? band0 : gathered[max(i - 1, 0)] - gathered[i];
    c[i] = abs(difference) / max(gathered[i + 1], run.light.w) * run.bands[i].y;
  }
#endif
  vec2 judged = judge(c, adaptation);
  imageStore(threshold, at, vec4(run.rule.z * judged.y * judged.x));
#if STAGES
  imageStore(stages, at, vec4(adaptation, judged.x, 0.0, 0.0));
#endif
}

#if LEVELS > 1
#if STACK
void loadStack(int thread) {
  // Coarsest level.
  {
    ivec2 origin = originOf(kPlanes), count = countOf(kPlanes), size = textureSize(gaussian, kPlanes - 1);
    const int stride = kWidth[kPlanes - 1];
    for (int i = thread; i < stride * count.y; i += 256) {
      ivec2 at = ivec2(i % stride, i / stride);
      if (at.x >= count.x) continue;
      float value = stored(kPlanes, clamp(origin + at, ivec2(0), size - 1));
      if (kPlanes % 2 == 1)
        atOdd[i] = value;
      else
        atEven[i] = value;
    }
  }
  barrier();
  // From level i + 1 to level i; plane 0 is the coarsest level, the finer ones follow.
  for (int i = kPlanes - 1; i >= 1; --i) {
    ivec2 origin = originOf(i), count = countOf(i), size = textureSize(gaussian, i - 1);
    ivec2 below = originOf(i + 1), belowSize = textureSize(gaussian, i);
    int stride = kWidth[i - 1], belowStride = kWidth[i], planes = kPlanes - i;
    for (int p = thread; p < stride * count.y; p += 256) {
      ivec2 at = ivec2(p % stride, p / stride);
      if (at.x >= count.x) continue;
      ivec2 sampleAt = clamp(origin + at, ivec2(0), size - 1), left;
      vec2 t;
      place(sampleAt.x, belowSize.x, size.x, left.x, t.x);
      place(sampleAt.y, belowSize.y, size.y, left.y, t.y);
      int from = (left.y - below.y) * belowStride + left.x - below.x;
      float own = stored(i, sampleAt), value = 0.0;
      for (int plane = 0; plane < planes; ++plane) {
        if (i % 2 == 1) {
          int q = plane * kCoarserPlaneSize + from;
          value = between(atEven[q], atEven[q + 1], atEven[q + belowStride], atEven[q + belowStride + 1], t);
          atOdd[plane * kPlaneSize + p] = value;
        } else {
          int q = plane * kPlaneSize + from;
          value = between(atOdd[q], atOdd[q + 1], atOdd[q + belowStride], atOdd[q + belowStride + 1], t);
          atEven[plane * kCoarserPlaneSize + p] = value;
        }
      }
#if LAPLACIAN
      if (i <= HALF_LEVELS) own += value;  // the last plane is level i + 1
#endif
      if (i % 2 == 1)
        atOdd[planes * kPlaneSize + p] = own;
      else
        atEven[planes * kCoarserPlaneSize + p] = own;
    }
    barrier();
  }
}
#else
void loadPyramid(int thread, ivec2 tile, ivec2 fullSize) {
#if LAPLACIAN
  for (int i = kPlanes; i >= 1; --i) {
    if (i <= HALF_LEVELS) barrier();
#else
  for (int i = 1; i <= kPlanes; ++i) {
#endif
    ivec2 origin = originOf(i), count = countOf(i), size = textureSize(gaussian, i - 1);
    int stride = kWidth[i - 1];
    for (int p = thread; p < stride * count.y; p += 256) {
      ivec2 at = ivec2(p % stride, p / stride);
      if (at.x >= count.x) continue;
      ivec2 sampleAt = clamp(origin + at, ivec2(0), size - 1);
      float value = stored(i, sampleAt);
#if LAPLACIAN
      if (i <= HALF_LEVELS) {
        ivec2 below = originOf(i + 1), belowSize = textureSize(gaussian, i), left;
        vec2 t;
        place(sampleAt.x, belowSize.x, size.x, left.x, t.x);
        place(sampleAt.y, belowSize.y, size.y, left.y, t.y);
        int q = kStart[i] + (left.y - below.y) * kWidth[i] + left.x - below.x;
        value += between(level[q], level[q + 1], level[q + kWidth[i]], level[q + kWidth[i] + 1], t);
      }
#endif
      level[kStart[i - 1] + p] = value;
    }
  }
  for (int i = thread; i < kPlanes * kTile.y; i += 256) {
    int plane = i / kTile.y, y = min(tile.y + i % kTile.y, fullSize.y - 1), left;
    float t;
    place(y, textureSize(gaussian, plane).y, fullSize.y, left, t);
    rowLeft[i] = left - originOf(plane + 1).y;
    rowRest[i] = t;
  }
  barrier();
}
#endif
#endif

void main() {
  int thread = int(gl_LocalInvocationIndex);
  ivec2 size = imageSize(threshold);
  ivec2 tile = ivec2(gl_WorkGroupID.xy) * kTile;
  int x = tile.x + thread % kTile.x, firstRow = thread / kTile.x * kRun;
#if LEVELS == 1
  for (int i = 0; i < kRun; ++i) {
    ivec2 at = ivec2(x, tile.y + firstRow + i);
    if (all(lessThan(at, size))) finish(at, texelFetch(finest, at, 0).r, float[1](0.0));
  }
#else
  // Two rows of samples around the pixel, interpolated along x; they move down with the pixel.
  float upper[kPlanes], lower[kPlanes];
#if STACK
  loadStack(thread);
  if (x >= size.x) return;
  ivec2 sampleSize = textureSize(gaussian, 0), origin = originOf(1);
  int left, row = -1000;
  float tx;
  place(x, sampleSize.x, size.x, left, tx);
  left -= origin.x;
  for (int i = 0; i < kRun; ++i) {
    ivec2 at = ivec2(x, tile.y + firstRow + i);
    if (at.y >= size.y) return;
    float finestValue = decoded(texelFetch(finest, at, 0).r);
    int top;
    float ty;
    place(at.y, sampleSize.y, size.y, top, ty);
    top -= origin.y;
    if (top != row) {
      bool moved = top == row + 1;
      row = top;
      for (int plane = 0; plane < kPlanes; ++plane) {
        // Planes lie coarsest first.
        int q = (kPlanes - 1 - plane) * kPlaneSize + top * kWidth[0] + left;
        upper[plane] = moved ? lower[plane] : atOdd[q] + tx * (atOdd[q + 1] - atOdd[q]);
        q += kWidth[0];
        lower[plane] = atOdd[q] + tx * (atOdd[q + 1] - atOdd[q]);
      }
    }
    float gathered[kPlanes];
    for (int plane = 0; plane < kPlanes; ++plane)
      gathered[plane] = upper[plane] + ty * (lower[plane] - upper[plane]);
    finish(at, finestValue, gathered);
  }
#else
  loadPyramid(thread, tile, size);
  if (x >= size.x) return;
  int column[kPlanes], row[kPlanes];
  float tx[kPlanes];
  for (int plane = 0; plane < kPlanes; ++plane) {
    int left;
    place(x, textureSize(gaussian, plane).x, size.x, left, tx[plane]);
    column[plane] = kStart[plane] + left - originOf(plane + 1).x;
    row[plane] = -1000;
  }
  for (int i = 0; i < kRun; ++i) {
    ivec2 at = ivec2(x, tile.y + firstRow + i);
    if (at.y >= size.y) return;
    float finestValue = decoded(texelFetch(finest, at, 0).r), gathered[kPlanes];
    for (int plane = 0; plane < kPlanes; ++plane) {
      int entry = plane * kTile.y + firstRow + i, top = rowLeft[entry];
      if (top != row[plane]) {
        int q = column[plane] + top * kWidth[plane];
        upper[plane] = top == row[plane] + 1 ? lower[plane] : level[q] + tx[plane] * (level[q + 1] - level[q]);
        q += kWidth[plane];
        lower[plane] = level[q] + tx[plane] * (level[q + 1] - level[q]);
        row[plane] = top;
      }
      gathered[plane] = upper[plane] + rowRest[entry] * (lower[plane] - upper[plane]);
    }
    finish(at, finestValue, gathered);
  }
#endif
#endif
}
