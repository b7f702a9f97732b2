// SPDX-License-Identifier: BSD-3-Clause
// Picture as a display takes it: mean of the samples of each pixel's square, coded in 8 bits by the display's
// transfer curve. See display_coding.h.
#include "study/stimulus/encode_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kEncodePictureUnit) uniform sampler2D picture;
#ifdef VISIBILITY
layout(binding = kEncodeUnlitUnit) uniform sampler2D unlit;
layout(binding = kEncodeVisibilityUnit) uniform sampler2D visibility;
#endif
layout(binding = kEncodeThresholdsUnit) uniform sampler2D thresholds;  // 255 x 1
layout(binding = kEncodeImage, rgba8) uniform writeonly image2D outImage;
uniform int samples;
uniform ivec2 sizePx;

vec3 light(ivec2 at) {
  const vec3 lit = texelFetch(picture, at, 0).rgb;
#ifdef VISIBILITY
  const vec3 ambient = texelFetch(unlit, at, 0).rgb;
  return ambient + texelFetch(visibility, at, 0).x * (lit - ambient);
#else
  return lit;
#endif
}

// How many thresholds the light reaches. NaN reaches none.
float code(float value) {
  int reached = 0;
  for (int stride = 128; stride > 0; stride >>= 1)
    if (value >= texelFetch(thresholds, ivec2(reached + stride - 1, 0), 0).x) reached += stride;
  return float(reached) / 255.0;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  vec3 sum = vec3(0.0);
  for (int y = 0; y < samples; ++y)
    for (int x = 0; x < samples; ++x) sum += light(pixel * samples + ivec2(x, y));
  sum /= float(samples * samples);
  imageStore(outImage, pixel, vec4(code(sum.r), code(sum.g), code(sum.b), 1.0));
}
