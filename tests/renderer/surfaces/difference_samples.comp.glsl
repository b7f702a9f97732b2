// SPDX-License-Identifier: BSD-3-Clause
// Cubics at `segments` + 1 places by forward differences: one invocation a curve.
#include "tests/renderer/surfaces/bezier_samples_bindings.h"

layout(local_size_x = 64) in;
layout(std430, binding = kBezierPointsBuffer) readonly buffer Points { vec4 points[]; };
layout(std430, binding = kBezierResultsBuffer) writeonly buffer Results { vec4 results[]; };  // value, derivative
uniform int count, segments, restart;

#define DIFFERENCE vec4
#include "renderer/surfaces/forward_differences.glsl"

void main() {
  const int index = int(gl_GlobalInvocationID.x);
  if (index >= count) return;
  const CubicPowers powers = powersOf(points[4 * index], points[4 * index + 1], points[4 * index + 2], points[4 * index + 3]);
  const float by = 1.0 / float(segments);
  CubicRun value;
  QuadraticRun slope;
  for (int i = 0; i <= segments; ++i) {
    if (i % restart == 0) {
      value = cubicRun(powers, float(i) / float(segments), by);
      slope = slopeRun(powers, float(i) / float(segments), by);
    }
    const int at = 2 * (index * (segments + 1) + i);
    results[at] = value.value;
    results[at + 1] = slope.value;
    step_(value);
    step_(slope);
  }
}
