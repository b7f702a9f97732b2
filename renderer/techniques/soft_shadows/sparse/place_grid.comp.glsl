// SPDX-License-Identifier: BSD-3-Clause
// Takes every `factor`-th pixel of each row and column of a picture, and its last ones, as what a smaller frame sees.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform usampler2D triangleIds;
layout(binding = 0, r32ui) uniform writeonly uimage2D outIds;
layout(binding = 1, rg32f) uniform writeonly image2D outPlaces;
uniform ivec2 pictureSizePx, gridSizePx;
uniform int factor;

void main() {
  const ivec2 sampled = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(sampled, gridSizePx))) return;
  const ivec2 pixel = min(factor * sampled, pictureSizePx - 1);
  imageStore(outIds, sampled, texelFetch(triangleIds, pixel, 0));
  imageStore(outPlaces, sampled, vec4(vec2(pixel) + 0.5, 0.0, 0.0));
}
