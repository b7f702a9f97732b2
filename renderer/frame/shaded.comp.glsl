// SPDX-License-Identifier: BSD-3-Clause
// Colour of each pixel from the triangle that it sees. See shaded.h.
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kShadedIdsUnit) uniform usampler2D triangleIds;
layout(binding = kShadedOutImage, rgba32f) uniform writeonly image2D outImage;
#ifdef SHADOW
layout(binding = kShadedReceiversUnit) uniform sampler2D receivers;
#include "renderer/frame/hard_shadow.glsl"
#endif

uniform ivec2 sizePx;
#include "renderer/frame/shading.glsl"

#ifdef LIT
float sunShare(ivec2 pixel, SeenPoint seen) {
#ifdef SHADOW
  return hardShadow(texelFetch(receivers, pixel, 0));
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
