// SPDX-License-Identifier: BSD-3-Clause
// What a display can show of a picture: light between its black and its white.
#include "renderer/techniques/popping/switch_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kClampPictureUnit) uniform sampler2D picture;
layout(binding = kClampShownImage, rgba32f) uniform writeonly image2D shown;
uniform ivec2 sizePx;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  imageStore(shown, pixel, vec4(clamp(texelFetch(picture, pixel, 0).xyz, 0.0, 1.0), 1.0));
}
