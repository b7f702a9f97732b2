// SPDX-License-Identifier: BSD-3-Clause
// Shades pixels with visibility that passes before this one have found.
#include "renderer/techniques/soft_shadows/shaded/shaded_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kShadeIdsUnit) uniform usampler2D triangleIds;
layout(binding = kShadeReceiversUnit) uniform sampler2D receivers;
layout(binding = kShadeVisibilityUnit) uniform sampler2D visibilities;
layout(binding = kShadeImage, rgba32f) uniform writeonly image2D outImage;
uniform ivec2 sizePx;
#include "renderer/frame/shading.glsl"

float sunShare(ivec2 pixel, SeenPoint seen) {
  return texelFetch(receivers, pixel, 0).w < 0.0 ? 0.0 : texelFetch(visibilities, pixel, 0).x;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  imageStore(outImage, pixel, vec4(shadedColour(pixel, texelFetch(triangleIds, pixel, 0).x), 1.0));
}
