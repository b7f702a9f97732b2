// SPDX-License-Identifier: BSD-3-Clause
// Mean of the samples of each pixel's square.
#include "renderer/techniques/lod/lod_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kBoxResolveSampledUnit) uniform sampler2D sampled;
layout(binding = kBoxResolveImage, rgba32f) uniform writeonly image2D outImage;
uniform int samples;
uniform ivec2 sizePx;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  vec4 sum = vec4(0.0);
  for (int y = 0; y < samples; ++y)
    for (int x = 0; x < samples; ++x) sum += texelFetch(sampled, pixel * samples + ivec2(x, y), 0);
  imageStore(outImage, pixel, sum / float(samples * samples));
}
