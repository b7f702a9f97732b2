// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/reference_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSampledLightResolveReceiversUnit) uniform sampler2D receivers;
layout(binding = kSampledLightResolveLitCountsImage, r32ui) uniform readonly uimage2D litCounts;
layout(binding = kSampledLightResolveVisibilityImage, r32f) uniform writeonly image2D visibility;

uniform ivec2 sizePx;
uniform int samples;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const bool receives = texelFetch(receivers, pixel, 0).w >= 0.0;
  imageStore(visibility, pixel, vec4(receives ? float(imageLoad(litCounts, pixel).x) / float(samples) : 1.0));
}
