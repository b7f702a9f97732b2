// SPDX-License-Identifier: BSD-3-Clause
// Mean of all rays of each pixel.
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kRayGatherSumsUnit) uniform sampler2D sums;
layout(binding = kRayGatherImage, rgba32f) uniform writeonly image2D picture;
uniform ivec2 sizePx;
uniform float weight;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  imageStore(picture, pixel, vec4(weight * texelFetch(sums, pixel, 0).rgb, 1.0));
}
