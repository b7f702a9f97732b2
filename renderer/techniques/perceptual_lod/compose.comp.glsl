// SPDX-License-Identifier: BSD-3-Clause
// The picture of all layers and, for one layer, its surroundings C_i: the luminance that the picture would have without
// that layer, with the shadows that fall on the layer's visible surfaces as a pattern on it.
#include "renderer/techniques/perceptual_lod/gathered.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kComposePictureImage, rgba32f) uniform writeonly image2D picture;
layout(binding = kComposeBehindImage, r32f) uniform writeonly image2D behind;    // cd/m2 without the layer, where it is seen
layout(binding = kComposeContextImage, r32f) uniform writeonly image2D context;  // cd/m2

uniform int mappedLayer;    // kNoLayer: none
uniform float attenuation;  // of shadowed pixels; 1 without a mask

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  Key front, second;
  int layer;
  surfacesAt(pixel, front, layer, second);
  const vec3 seen = colourOf(front, pixel, kNoTest, 0);
  imageStore(picture, pixel, vec4(seen, 1.0));
  if (mappedLayer == kNoLayer) return;
  float luminance = luminanceCdM2(seen);
  if (front.depth > 0.0 && layer == mappedLayer) {
    const vec3 without = colourOf(second, pixel, kNoTest, 0);
    luminance = luminanceCdM2(without);
    imageStore(behind, pixel, vec4(luminance));
    if (attenuation < 1.0 && isMasked(front, pixel, layer)) luminance = luminanceCdM2(attenuation * without);
  }
  imageStore(context, pixel, vec4(luminance));
}
