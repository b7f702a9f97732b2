// SPDX-License-Identifier: BSD-3-Clause
// Moves what ComputeRaster gathered into textures and clears the buffers for the next frame.
layout(local_size_x = 64) in;
layout(std430, binding = 3) buffer Queue { uint queued; };
layout(std430, binding = 4) buffer Depths { uint depths[]; };
layout(binding = 0, r32f) uniform writeonly image2D depthImage;
#ifdef IDS
layout(std430, binding = 5) buffer Ids { uint ids[]; };
layout(binding = 1, r32ui) uniform writeonly uimage2D idImage;
#endif
uniform ivec2 sizePx;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel == ivec2(0)) queued = 0u;
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const int at = pixel.y * sizePx.x + pixel.x;
  imageStore(depthImage, pixel, vec4(uintBitsToFloat(depths[at])));
  depths[at] = 0u;
#ifdef IDS
  imageStore(idImage, pixel, uvec4(ids[at]));
  ids[at] = 0xffffffffu;
#endif
}
