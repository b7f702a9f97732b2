// SPDX-License-Identifier: BSD-3-Clause
// One picture of two levels of detail. See blend.cpp.
#include "renderer/techniques/lod/lod_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kBlendOldLevelUnit) uniform sampler2D oldLevel;
layout(binding = kBlendNewLevelUnit) uniform sampler2D newLevel;
layout(binding = kBlendImage, rgba32f) uniform writeonly image2D outImage;
uniform float weight;  // share of the new level
uniform ivec2 sizePx;
#ifdef ALTERNATING
// Motion of what is shown now; the other level's picture is of the previous frame.
#ifdef REPROJECT
layout(binding = kBlendDisplacementUnit) uniform sampler2D displacement;
#endif
uniform int previousIsNew;

// Ordered dither, 8 x 8: thresholds (k + 1/2) / 64, each once a tile (Bayer 1973).
float threshold(ivec2 pixel) {
  int k = 0;
  for (int bit = 0; bit < 3; ++bit) {
    const int x = (pixel.x >> bit) & 1, y = (pixel.y >> bit) & 1;
    k |= ((x ^ y) * 2 + y) << (2 * (2 - bit));
  }
  return (float(k) + 0.5) / 64.0;
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
#ifdef ALTERNATING
  const bool showNew = threshold(pixel) < weight;
  ivec2 at = pixel;
#ifdef REPROJECT
  if (showNew == (previousIsNew != 0))
    at = clamp(ivec2(floor(vec2(pixel) + 0.5 - texelFetch(displacement, pixel, 0).xy)), ivec2(0), sizePx - 1);
#endif
  const vec4 colour = showNew ? texelFetch(newLevel, at, 0) : texelFetch(oldLevel, at, 0);
#else
  const vec4 a = texelFetch(oldLevel, pixel, 0), b = texelFetch(newLevel, pixel, 0);
  const vec4 colour = (1.0 - weight) * a + weight * b;
#endif
  imageStore(outImage, pixel, colour);
}
