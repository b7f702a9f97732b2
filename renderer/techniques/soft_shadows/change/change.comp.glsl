// SPDX-License-Identifier: BSD-3-Clause
// Change of visibility over one step of the light, or the mean of several steps' absolute changes. See change.cpp.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D visibilityBefore;
layout(binding = 1) uniform sampler2D visibilityAfter;
layout(binding = 2) uniform sampler2D receiversBefore;
layout(binding = 3) uniform sampler2D receiversAfter;
layout(binding = 0, r32f) uniform image2D change;

uniform ivec2 sizePx;
uniform int isFirst;
uniform float steps;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  float value = 0.0;
  // Surfaces that turn to the light, or away from it, change by their cosine and not by their shadow.
  if (texelFetch(receiversBefore, pixel, 0).w >= 0.0 && texelFetch(receiversAfter, pixel, 0).w >= 0.0)
    value = texelFetch(visibilityAfter, pixel, 0).x - texelFetch(visibilityBefore, pixel, 0).x;
#ifdef MEAN_ABSOLUTE
  value = abs(value) / steps;
  if (isFirst == 0) value += imageLoad(change, pixel).x;
#endif
  imageStore(change, pixel, vec4(value));
}
