// SPDX-License-Identifier: BSD-3-Clause
// M_i: 1 where a surface of the layer is shadowed by objects of other layers. The map holds all casters but
// the layer's own. Surfaces turned away from the light are dark by themselves and not marked. The comparison
// is that of renderer/frame/shaded.comp.glsl.
#include "renderer/techniques/perceptual_lod/perceptual_lod_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kShadowMaskReceiversUnit) uniform sampler2D receivers;
layout(binding = kShadowMaskShadowMapUnit) uniform sampler2D shadowMap;
layout(binding = kShadowMaskImage, r32f) uniform writeonly image2D mask;

uniform ivec2 sizePx;
uniform vec2 tangentLow, tangentSize;
uniform int resolution;
uniform float bias, slopeBias, maxSlope;

float shadowed(vec4 receiver) {
  if (receiver.w < 0.0) return 0.0;
  const vec2 at = (receiver.xy / receiver.z - tangentLow) / tangentSize * float(resolution);
  if (!(all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(float(resolution)))))) return 0.0;
  const float texel = max(tangentSize.x, tangentSize.y) / float(resolution);
  const float slope = min(receiver.w, maxSlope * receiver.z);
  const float biased = receiver.z - bias * receiver.z - slopeBias * slope * texel;
  return texelFetch(shadowMap, ivec2(at), 0).x < biased ? 1.0 : 0.0;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  imageStore(mask, pixel, vec4(shadowed(texelFetch(receivers, pixel, 0))));
}
