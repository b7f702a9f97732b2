// SPDX-License-Identifier: BSD-3-Clause
// One frame more of a visibility history. See visibility_history.h.
#include "renderer/techniques/soft_shadows/history/history_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kHistoryReceiversUnit) uniform sampler2D receivers;
layout(binding = kHistoryPresentVisibilityUnit) uniform sampler2D presentVisibility;
layout(binding = kHistoryDepthsUnit) uniform sampler2D depths;
layout(binding = kHistoryNormalsUnit) uniform sampler2D normals;
layout(binding = kHistoryPastVisibilityUnit) uniform sampler2D pastVisibility;
layout(binding = kHistoryPastSurfaceUnit) uniform sampler2D pastSurface;  // normal, depth; depth 0: no receiver
#ifdef MOVING
layout(binding = kHistoryDisplacementUnit) uniform sampler2D displacement;
layout(binding = kHistoryPreviousDepthUnit) uniform sampler2D previousDepth;
#endif
#ifdef FATES
layout(binding = kHistoryFateImage, r32ui) uniform writeonly uimage2D outFate;
#else
layout(binding = kHistoryVisibilityImage, r32f) uniform writeonly image2D outVisibility;
layout(binding = kHistorySurfaceImage, rgba32f) uniform writeonly image2D outSurface;
#endif

uniform ivec2 sizePx;
uniform int hasPast, clampRadius;
uniform float alpha, depthTolerance, normalCosine;

bool isReceiver(ivec2 pixel) { return texelFetch(receivers, pixel, 0).w >= 0.0; }

struct Past {
  float visibility;
  bool known;
};

// Mean, by the bilinear weights, of those of four past pixels that show the surface at hand.
Past findPast(ivec2 pixel, vec3 normal, float depth) {
#ifdef MOVING
  const float expectedDepth = texelFetch(previousDepth, pixel, 0).x;
  // In pixel centres. Bounded to just outside the image: far places must not leave an integer's range.
  const vec2 then = clamp(vec2(pixel) - texelFetch(displacement, pixel, 0).xy, vec2(-2.0), vec2(sizePx) + 1.0);
#else
  const float expectedDepth = depth;
  const vec2 then = vec2(pixel);
#endif
  const vec2 corner = floor(then), share = then - corner;
  Past past = Past(0.0, false);
  // Beside or behind the eye at that time.
  if (hasPast == 0 || expectedDepth <= 0.0) return past;
  float weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    const ivec2 offset = ivec2(i & 1, i >> 1), tap = ivec2(corner) + offset;
    const vec2 axes = mix(1.0 - share, share, vec2(offset));
    const float weight = axes.x * axes.y;
    if (!(weight > 0.0) || any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, sizePx))) continue;
    const vec4 surface = texelFetch(pastSurface, tap, 0);
    if (surface.w == 0.0 || !(abs(surface.w - expectedDepth) <= depthTolerance * expectedDepth)) continue;
    if (!(dot(surface.xyz, normal) >= normalCosine - 1e-6)) continue;  // a unit normal's own square is not always 1
    weights += weight;
    past.visibility += weight * texelFetch(pastVisibility, tap, 0).x;
  }
  past.known = weights > 0.0;
  if (past.known && weights != 1.0) past.visibility /= weights;
  return past;
}

vec2 presentRange(ivec2 pixel) {
  vec2 range = vec2(texelFetch(presentVisibility, pixel, 0).x);
  const ivec2 low = max(pixel - clampRadius, ivec2(0)), high = min(pixel + clampRadius, sizePx - 1);
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      if (!isReceiver(ivec2(x, y))) continue;
      const float visibility = texelFetch(presentVisibility, ivec2(x, y), 0).x;
      range = vec2(min(range.x, visibility), max(range.y, visibility));
    }
  return range;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  uint fate = kFateNoReceiver;
  float visibility = 1.0;
  vec4 surface = vec4(0.0);
  if (isReceiver(pixel)) {
    fate = kFateNoPast;
    visibility = texelFetch(presentVisibility, pixel, 0).x;
    surface = vec4(texelFetch(normals, pixel, 0).xyz, texelFetch(depths, pixel, 0).x);
    const Past past = findPast(pixel, surface.xyz, surface.w);
    if (past.known) {
      fate = kFatePastTaken;
      float before = past.visibility;
      if (clampRadius > 0) {
        const vec2 range = presentRange(pixel);
        before = min(max(before, range.x), range.y);
        if (before != past.visibility) fate = kFatePastBounded;
      }
      // From the present on, so that it stays what it is, to the bit, where the past has no weight or agrees.
      precise const float averaged = visibility + (1.0 - alpha) * (before - visibility);
      visibility = averaged;
    }
  }
#ifdef FATES
  imageStore(outFate, pixel, uvec4(fate));
#else
  imageStore(outVisibility, pixel, vec4(visibility));
  imageStore(outSurface, pixel, surface);
#endif
}
