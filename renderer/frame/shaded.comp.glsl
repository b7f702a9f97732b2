// SPDX-License-Identifier: BSD-3-Clause
// Colour of each pixel from the triangle that it sees. See shaded.h.
#include "renderer/frame/shaded_surface.glsl"
#ifdef SHADOW
#include "renderer/frame/shadow_lookup.glsl"
#endif

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kShadedIdsUnit) uniform usampler2D triangleIds;
layout(binding = kShadedOutImage, rgba32f) uniform writeonly image2D outImage;
#ifdef SHADOW
layout(binding = kShadedReceiversUnit) uniform sampler2D receivers;
layout(binding = kShadedShadowMapUnit) uniform sampler2D shadowMap;
#endif

const uint kNone = 0xffffffffu;

float litAt(ivec2 pixel) {
#ifdef SHADOW
  const vec4 receiver = texelFetch(receivers, pixel, 0);
  if (receiver.w < 0.0) return 0.0;  // averted from the light
  const ShadowLookup lookup = shadowLookup(receiver);
  if (!lookup.inMap) return 1.0;
  return texelFetch(shadowMap, lookup.texel, 0).x < lookup.biased ? 0.0 : 1.0;
#else
  return 1.0;
#endif
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(triangleIds, pixel, 0).x;
  vec3 colour = background;
  if (id != kNone) colour = surfaceColour(id, surfaceSeen(id, pixel), litAt(pixel));
  imageStore(outImage, pixel, vec4(colour, 1.0));
}
