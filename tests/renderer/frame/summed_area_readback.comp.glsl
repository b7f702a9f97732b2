// SPDX-License-Identifier: BSD-3-Clause
// Sums over many rectangles, for comparison with sums in double precision.
#include "tests/renderer/frame/readback_bindings.h"

#define SUMS_UNIT kSumsReadbackSumsUnit
#include "renderer/frame/summed_area_table.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = kSumsReadbackWindowsBuffer) readonly buffer Windows { vec4 windows[]; };  // low, high
layout(std430, binding = kSumsReadbackTotalsBuffer) writeonly buffer Totals { vec2 totals[]; };   // a layer after another
uniform int count, layers;

void main() {
  const int i = int(gl_GlobalInvocationID.x);
  if (i >= count) return;
  for (int layer = 0; layer < layers; ++layer)
    totals[layer * count + i] = boxSum(windows[i].xy, windows[i].zw, layer);
}
