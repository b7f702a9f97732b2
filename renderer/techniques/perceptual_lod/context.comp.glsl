// SPDX-License-Identifier: BSD-3-Clause
// C_i: what the picture would show without layer i, with the shadows that fall on the layer's visible surfaces
// as a pattern on it.
#include "renderer/techniques/perceptual_lod/perceptual_lod_bindings.h"
#include "renderer/techniques/perceptual_lod/surface_key.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kContextFrontColourUnit) uniform sampler2D frontColour;
layout(binding = kContextFrontKeyUnit) uniform usampler2D frontKey;
layout(binding = kContextSecondColourUnit) uniform sampler2D secondColour;
layout(binding = kContextMaskUnit) uniform sampler2D mask;
layout(binding = kContextImage, rgba32f) uniform writeonly image2D context;

uniform ivec2 sizePx;
uniform int layer;
uniform float attenuation;  // of shadowed pixels; 1 without a mask

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  vec3 colour = texelFetch(frontColour, pixel, 0).rgb;
  if (unpackKey(texelFetch(frontKey, pixel, 0)).layer == uint(layer)) {
    colour = texelFetch(secondColour, pixel, 0).rgb;
    if (attenuation < 1.0 && texelFetch(mask, pixel, 0).x > 0.5) colour *= attenuation;
  }
  imageStore(context, pixel, vec4(colour, 1.0));
}
