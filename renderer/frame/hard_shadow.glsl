// SPDX-License-Identifier: BSD-3-Clause
// Hard shadow by a map from the light's centre, set up by configureHardShadow() (see shaded.h).
#include "renderer/frame/frame_bindings.h"

layout(binding = kShadedShadowMapUnit) uniform sampler2D shadowMap;
uniform vec2 tangentLow, tangentSize;
uniform int resolution;
uniform float bias, slopeBias, maxSlope;

// Share of the light that reaches a receiver (see Receivers in g_buffer.h): 0 or 1.
float hardShadow(vec4 receiver) {
  if (receiver.w < 0.0) return 0.0;  // averted from the light
  const vec2 at = (receiver.xy / receiver.z - tangentLow) / tangentSize * float(resolution);
  if (!(all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(float(resolution)))))) return 1.0;
  const float texel = max(tangentSize.x, tangentSize.y) / float(resolution);
  const float slope = min(receiver.w, maxSlope * receiver.z);
  const float biased = receiver.z - bias * receiver.z - slopeBias * slope * texel;
  return texelFetch(shadowMap, ivec2(at), 0).x < biased ? 0.0 : 1.0;
}
