// SPDX-License-Identifier: BSD-3-Clause
// Inclusive prefix sums along the rows, or the columns, of all layers, in place. A group takes eight lines, 32 texels of
// each at a time: scanned in shared memory (Hillis and Steele 1986), then added to what came before.
#include "renderer/frame/frame_bindings.h"

#ifdef COLUMNS
layout(local_size_x = kSumsLines, local_size_y = kSumsTile) in;
#else
layout(local_size_x = kSumsTile, local_size_y = kSumsLines) in;
#endif
#ifdef FIXED
#define VALUE uvec2
layout(binding = kSumsImage, TEXEL) uniform uimage2DArray sums;
#else
#define VALUE vec2
layout(binding = kSumsImage, TEXEL) uniform image2DArray sums;
#endif
#ifdef MEAN
layout(std430, binding = kSumsMeansBuffer) readonly buffer Means { vec2 means[]; };
#endif
uniform int resolution;

shared VALUE partial[2][kSumsLines][kSumsTile];

void main() {
#ifdef COLUMNS
  const int lane = int(gl_LocalInvocationID.y), row = int(gl_LocalInvocationID.x);
#else
  const int lane = int(gl_LocalInvocationID.x), row = int(gl_LocalInvocationID.y);
#endif
  const int line = int(gl_WorkGroupID.x) * kSumsLines + row, layer = int(gl_WorkGroupID.y);
  VALUE before = VALUE(0);
  for (int first = 0; first < resolution; first += kSumsTile) {
    const int at = first + lane;
    const bool inside = max(at, line) < resolution;
#ifdef COLUMNS
    const ivec3 texel = ivec3(line, at, layer);
#else
    const ivec3 texel = ivec3(at, line, layer);
#endif
    VALUE value = VALUE(0);
    if (inside) {
      value = imageLoad(sums, texel).xy;
#ifdef MEAN
      value -= means[layer];
#endif
    }
    // Two copies in turn, so that one barrier a step is enough: what a step reads is not written before the next.
    partial[0][row][lane] = value;
    barrier();
    int current = 0;
    for (int step = 1; step < kSumsTile; step <<= 1) {
      VALUE sum = partial[current][row][lane];
      if (lane >= step) sum += partial[current][row][lane - step];
      current = 1 - current;
      partial[current][row][lane] = sum;
      barrier();
    }
    if (inside) imageStore(sums, texel, (before + partial[current][row][lane]).xyxy);
    before += partial[current][row][kSumsTile - 1];
  }
}
