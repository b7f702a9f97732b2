// SPDX-License-Identifier: BSD-3-Clause
// The metrics of windows that a test gives.
#include "tests/renderer/antialiasing/metric_bindings.h"

layout(local_size_x = 1) in;
layout(std430, binding = kMetricWindowsBuffer) readonly buffer Windows { vec4 samples[]; };
layout(std430, binding = kMetricResultsBuffer) writeonly buffer Results { vec4 results[]; };
const int kSamples = 16;
#include "renderer/techniques/antialiasing/window_metrics.glsl"

void main() {
  float depths[kSamples];
  vec3 normals[kSamples];
  for (int i = 0; i < kSamples; ++i) {
    const vec4 each = samples[gl_GlobalInvocationID.x * uint(kSamples) + uint(i)];
    normals[i] = each.xyz;
    depths[i] = each.w;
  }
  results[gl_GlobalInvocationID.x] =
      vec4(depthRange(depths), normalCone(normals), depthVariance(depths), normalVariance(normals));
}
