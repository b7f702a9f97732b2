// SPDX-License-Identifier: BSD-3-Clause
// What variance and convolution shadow maps make of windows that hold two depths.
#include "tests/renderer/techniques/readback_bindings.h"
#include "renderer/frame/prefiltered_map.glsl"
#include "renderer/techniques/soft_shadows/variance/chebyshev.glsl"
#include "renderer/techniques/soft_shadows/convolution/fourier_step.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = kPrefilteredReadbackWindowsBuffer) readonly buffer Windows { vec4 windows[]; };  // two depths, share of the first, receiver
layout(std430, binding = kPrefilteredReadbackMomentsBuffer) readonly buffer Moments { vec2 moments[]; };
layout(std430, binding = kPrefilteredReadbackResultsBuffer) writeonly buffer Results { vec2 results[]; };
uniform int count;
uniform float minVariance;

void main() {
  const int i = int(gl_GlobalInvocationID.x);
  if (i >= count) return;
  const vec4 window = windows[i];
  float lit = 0.5;
  for (int k = 0; k < terms; ++k)
    lit += stepTerm(k, mix(fourierTerm(k, window.y), fourierTerm(k, window.x), window.z), fourierTerm(k, window.w));
  results[i] = vec2(chebyshev(moments[i], window.w, minVariance), lit);
}
