// SPDX-License-Identifier: BSD-3-Clause
// A switch over time, as perception/popping/temporal_sensitivity.h. Mechanisms: x sustained, y transient, z red-green,
// w yellow-violet.
#include "perception/popping/gpu/masking.glsl"
#include "perception/popping/gpu/popping_bindings.h"

layout(binding = kResponseSteadyUnit) uniform sampler2D steadyGains;  // as `sensitivities`
layout(binding = kResponseOnsetUnit) uniform sampler2D onsetGains;

uniform float holdCyclesPerDegS;  // by which a band moves over the retina while a frame is held, at 1 deg/s of the eye

struct SwitchContent {
  vec3 contrast;  // A, a, b
  vec4 steady, onset;
};

float holdBlur(float eyeDegS) {
  float x = 3.14159265 * holdCyclesPerDegS * eyeDegS;
  return x > 1e-4 ? abs(sin(x) / x) : 1.0;
}

// contents: after the switch, before it.
// Contrasts over thresholds, before masking.
struct SwitchExtremes {
  vec4 after, before;
};

SwitchExtremes switchExtremes(SwitchContent contents[2], float blur) {
  precise vec4 after = blur * contents[0].contrast.xxyz, before = blur * contents[1].contrast.xxyz;
  precise vec4 mean = 0.5 * (contents[0].steady * after + contents[1].steady * before);
  precise vec4 half_ = 0.5 * (contents[0].onset * after - contents[1].onset * before);
  return SwitchExtremes(mean + half_, mean - half_);
}

vec3 switchDifference(SwitchExtremes extremes) {
  vec4 change;
  for (int m = 0; m < 4; ++m) change[m] = transducer(extremes.after[m]) - transducer(extremes.before[m]);
  return vec3(change.x + change.y, change.zw);
}
