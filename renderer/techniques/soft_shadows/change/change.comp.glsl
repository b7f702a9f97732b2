// SPDX-License-Identifier: BSD-3-Clause
// Change of visibility over one step of the light, or the mean of several steps' absolute changes. See change.cpp.
#include "renderer/techniques/soft_shadows/change/change_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kChangeVisibilityBeforeUnit) uniform sampler2D visibilityBefore;
layout(binding = kChangeVisibilityAfterUnit) uniform sampler2D visibilityAfter;
layout(binding = kChangeReceiversBeforeUnit) uniform sampler2D receiversBefore;
layout(binding = kChangeReceiversAfterUnit) uniform sampler2D receiversAfter;
layout(binding = kChangeImage, r32f) uniform image2D change;

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
