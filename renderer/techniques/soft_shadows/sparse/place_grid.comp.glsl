// SPDX-License-Identifier: BSD-3-Clause
// Takes every `factor`-th pixel of each row and column of a picture, and its last ones, as what a smaller frame sees.
#include "renderer/techniques/soft_shadows/sparse/sparse_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSparseGridIdsUnit) uniform usampler2D triangleIds;
layout(binding = kSparseGridIdsImage, r32ui) uniform writeonly uimage2D outIds;
layout(binding = kSparseGridPlacesImage, rg32f) uniform writeonly image2D outPlaces;
uniform ivec2 pictureSizePx, gridSizePx;
uniform int factor;

void main() {
  const ivec2 sampled = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(sampled, gridSizePx))) return;
  const ivec2 pixel = min(factor * sampled, pictureSizePx - 1);
  imageStore(outIds, sampled, texelFetch(triangleIds, pixel, 0));
  imageStore(outPlaces, sampled, vec4(vec2(pixel) + 0.5, 0.0, 0.0));
}
