// SPDX-License-Identifier: BSD-3-Clause
// Inclusive prefix sums along the rows, or the columns, of all layers, in place. A group takes eight lines, 32 texels of
// each at a time: scanned in shared memory (Hillis and Steele 1986), then added to what came before.
const int kTile = 32, kLines = 8;
#ifdef COLUMNS
layout(local_size_x = 8, local_size_y = 32) in;
#else
layout(local_size_x = 32, local_size_y = 8) in;
#endif
#ifdef FIXED
#define VALUE uvec2
layout(binding = 0, TEXEL) uniform uimage2DArray sums;
#else
#define VALUE vec2
layout(binding = 0, TEXEL) uniform image2DArray sums;
#endif
#ifdef MEAN
layout(std430, binding = 0) readonly buffer Means { vec2 means[]; };
#endif
uniform int resolution;

shared VALUE partial[2][kLines][kTile];

void main() {
#ifdef COLUMNS
  const int lane = int(gl_LocalInvocationID.y), row = int(gl_LocalInvocationID.x);
#else
  const int lane = int(gl_LocalInvocationID.x), row = int(gl_LocalInvocationID.y);
#endif
  const int line = int(gl_WorkGroupID.x) * kLines + row, layer = int(gl_WorkGroupID.y);
  VALUE before = VALUE(0);
  for (int first = 0; first < resolution; first += kTile) {
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
    for (int step = 1; step < kTile; step <<= 1) {
      VALUE sum = partial[current][row][lane];
      if (lane >= step) sum += partial[current][row][lane - step];
      current = 1 - current;
      partial[current][row][lane] = sum;
      barrier();
    }
    if (inside) imageStore(sums, texel, (before + partial[current][row][lane]).xyxy);
    before += partial[current][row][kTile - 1];
  }
}
