// SPDX-License-Identifier: BSD-3-Clause
// The two pictures that the predictor compares. Without CARRIED: test and reference. With it: the test frame, and the
// same frame as it would be had the test's error stayed what it was on each surface in the frame before.
#include "perception/metrics/jnd/jnd_bindings.h"
#include "perception/metrics/jnd/shown.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kShowTestUnit) uniform sampler2D test;
layout(binding = kShowReferenceUnit) uniform sampler2D reference;
layout(binding = kShowMaskUnit) uniform sampler2D mask;
layout(binding = kShowActualImage, rgba32f) uniform writeonly image2D actual;
layout(binding = kShowPredictedImage, rgba32f) uniform writeonly image2D predicted;
layout(binding = kShowEvaluatedImage, r8) uniform writeonly image2D evaluated;
uniform ivec2 sizePx;
uniform int region;  // 0: all, 1: receivers, 2: penumbra
uniform int hasMask;

#ifdef CARRIED
layout(binding = kShowDisplacementUnit) uniform sampler2D displacement;
layout(binding = kShowDepthBeforeUnit) uniform sampler2D depthBefore;
layout(binding = kShowEarlierDepthUnit) uniform sampler2D earlierDepth;
layout(binding = kShowEarlierTestUnit) uniform sampler2D earlierTest;
layout(binding = kShowEarlierReferenceUnit) uniform sampler2D earlierReference;
uniform int moves;
uniform float depthTolerance;  // share of the depth within which a point is that of the frame before

// Smallest weight of a texel in an interpolation that counts: below it, a position is that of its neighbour.
const float kLeastWeight = 1e-3;

vec3 earlierError(ivec2 pixel) {
  const vec3 exact = channels(texelFetch(earlierReference, pixel, 0));
  return sound(channels(texelFetch(earlierTest, pixel, 0)), exact) - exact;
}

// The error in the frame before of the surface that this pixel sees. Between pixels, the one closest to the present
// error of those between which an interpolation would lie: a picture that creeps by parts of a pixel is sampled
// elsewhere in every frame. Where the surface was not seen, the present error: it has changed from nothing.
vec3 carriedError(ivec2 pixel, vec3 present) {
  if (moves == 0) return earlierError(pixel);
  const float depth = texelFetch(depthBefore, pixel, 0).x;
  const vec2 at = vec2(pixel) - texelFetch(displacement, pixel, 0).xy;
  const ivec2 first = ivec2(floor(at));
  const vec2 share = at - vec2(first);
  vec3 low = vec3(3e38), high = vec3(-3e38);
  bool found = false;
  for (int i = 0; i < 4; ++i) {
    const ivec2 offset = ivec2(i & 1, i >> 1), from = first + offset;
    const vec2 weight = mix(1.0 - share, share, vec2(offset));
    if (weight.x < kLeastWeight || weight.y < kLeastWeight) continue;
    if (any(lessThan(from, ivec2(0))) || any(greaterThanEqual(from, sizePx))) continue;
    const float there = texelFetch(earlierDepth, from, 0).x;
    if (!(depth >= 0.0) || !(abs(there - depth) <= depthTolerance * depth)) continue;
    const vec3 error = earlierError(from);
    low = min(low, error), high = max(high, error);
    found = true;
  }
  return found ? clamp(present, low, high) : present;
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec3 exact = channels(texelFetch(reference, pixel, 0));
  const vec3 own = sound(channels(texelFetch(test, pixel, 0)), exact);
  vec3 expected = exact;
#ifdef CARRIED
  const vec3 present = own - exact, carried = carriedError(pixel, present);
  for (int c = 0; c < 3; ++c) {
    // An error that has not changed leaves the value itself, to the last digit.
    expected[c] = carried[c] == present[c] ? own[c] : exact[c] + carried[c];
    if (isShare != 0) expected[c] = clamp(expected[c], 0.0, 1.0);
  }
#endif
  imageStore(actual, pixel, vec4(shown(own, pixel), 1.0));
  imageStore(predicted, pixel, vec4(shown(expected, pixel), 1.0));
  bool counts = region == 0 || hasMask == 0 || texelFetch(mask, pixel, 0).x > 0.5;
  if (region == 2) counts = counts && exact.x > 0.0 && exact.x < 1.0;
  imageStore(evaluated, pixel, vec4(counts ? 1.0 : 0.0));
}
