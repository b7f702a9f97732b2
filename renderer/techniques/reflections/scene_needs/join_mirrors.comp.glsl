// SPDX-License-Identifier: BSD-3-Clause
// Takes a picture where pixels see the mirrors that it shows, or as a whole. See grouped_mirrors.h.
#include "renderer/techniques/reflections/reflection_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kReflectionOriginsUnit) uniform sampler2D origins;
layout(binding = kComposeReflectedUnit) uniform sampler2D picture;
layout(binding = kComposeImage, rgba32f) uniform writeonly image2D outImage;
uniform ivec2 sizePx;
uniform bool all;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  if (all || texelFetch(origins, pixel, 0).w > 0.0) imageStore(outImage, pixel, texelFetch(picture, pixel, 0));
}
