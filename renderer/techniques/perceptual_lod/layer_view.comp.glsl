// SPDX-License-Identifier: BSD-3-Clause
// O_i and M_i, for looking at: a layer as if nothing were before it, and where other layers shadow it.
#include "renderer/techniques/perceptual_lod/gathered.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kLayerViewImage, rgba32f) uniform writeonly image2D image;
layout(binding = kLayerViewMaskImage, r32f) uniform writeonly image2D mask;

uniform int shownLayer;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const Key key = keyIn(kFirstCameraRegion + shownLayer, pixel);
  imageStore(image, pixel, vec4(colourOf(key, pixel, kNoTest, 0), 1.0));
  imageStore(mask, pixel, vec4(key.depth > 0.0 && isMasked(key, pixel, shownLayer) ? 1.0 : 0.0));
}
