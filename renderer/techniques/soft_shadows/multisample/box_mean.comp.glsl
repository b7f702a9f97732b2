// SPDX-License-Identifier: BSD-3-Clause
// Mean visibility of a pixel's square of samples.
#include "renderer/techniques/soft_shadows/multisample/multisample_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kBoxMeanSampledUnit) uniform sampler2D sampled;
layout(binding = kBoxMeanVisibilityImage, VISIBILITY_FORMAT) uniform writeonly image2D outVisibility;
uniform int samples;  // along each axis
uniform ivec2 sizePx;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  vec4 sum = vec4(0.0);
  for (int y = 0; y < samples; ++y)
    for (int x = 0; x < samples; ++x) sum += texelFetch(sampled, pixel * samples + ivec2(x, y), 0);
  imageStore(outVisibility, pixel, sum / float(samples * samples));
}
