// SPDX-License-Identifier: BSD-3-Clause
// A layer behind those before it, as GL_SRC_ALPHA_SATURATE with a destination alpha of 1 at most (Roger 2008, section 5.2.4).
#include "renderer/techniques/reflections/cone_traced/cone_traced_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kPeelLayerUnit) uniform sampler2D layer;
layout(binding = kPeelResultImage, rgba32f) uniform image2D result;
uniform ivec2 sizePx;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 next = texelFetch(layer, pixel, 0);
  if (!(next.a > 0.0)) return;
  const vec4 sum = imageLoad(result, pixel);
  const float weight = min(next.a, max(1.0 - sum.a, 0.0));
  imageStore(result, pixel, sum + vec4(weight * next.rgb, weight));
}
