// SPDX-License-Identifier: BSD-3-Clause
// Where a receiver looks into a shadow map, and which depths shadow it.

uniform vec2 tangentLow, tangentSize;
uniform int resolution;
uniform float bias, slopeBias, maxSlope;

struct ShadowLookup {
  bool inMap;
  ivec2 texel;
  float biased;  // light-space z: what is nearer shadows the receiver
};

// `receiver` as frame::Receivers has them, w >= 0.
ShadowLookup shadowLookup(vec4 receiver) {
  const vec2 at = (receiver.xy / receiver.z - tangentLow) / tangentSize * float(resolution);
  const float texel = max(tangentSize.x, tangentSize.y) / float(resolution);
  const float slope = min(receiver.w, maxSlope * receiver.z);
  const bool inMap = all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(float(resolution))));
  return ShadowLookup(inMap, ivec2(at), receiver.z - bias * receiver.z - slopeBias * slope * texel);
}
