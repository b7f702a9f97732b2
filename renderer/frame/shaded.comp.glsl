// SPDX-License-Identifier: BSD-3-Clause
// Colour of each pixel from the triangle that it sees. See shaded.h.
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kShadedIdsUnit) uniform usampler2D triangleIds;
layout(binding = kShadedOutImage, rgba32f) uniform writeonly image2D outImage;
#ifdef SHADOW
layout(binding = kShadedReceiversUnit) uniform sampler2D receivers;
layout(binding = kShadedShadowMapUnit) uniform sampler2D shadowMap;
uniform vec2 tangentLow, tangentSize;
uniform int resolution;
uniform float bias, slopeBias, maxSlope;
#endif

uniform ivec2 sizePx;
#include "renderer/frame/shading.glsl"

#ifdef LIT
float sunShare(ivec2 pixel, SeenPoint seen) {
#ifdef SHADOW
  const vec4 receiver = texelFetch(receivers, pixel, 0);
  if (receiver.w < 0.0) return 0.0;  // averted from the light
  const vec2 at = (receiver.xy / receiver.z - tangentLow) / tangentSize * float(resolution);
  if (!(all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(float(resolution)))))) return 1.0;
  const float texel = max(tangentSize.x, tangentSize.y) / float(resolution);
  const float slope = min(receiver.w, maxSlope * receiver.z);
  const float biased = receiver.z - bias * receiver.z - slopeBias * slope * texel;
  return texelFetch(shadowMap, ivec2(at), 0).x < biased ? 0.0 : 1.0;
#else
  return 1.0;
#endif
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  imageStore(outImage, pixel, vec4(shadedColour(pixel, texelFetch(triangleIds, pixel, 0).x), 1.0));
}
