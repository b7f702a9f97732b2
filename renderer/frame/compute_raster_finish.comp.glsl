// SPDX-License-Identifier: BSD-3-Clause
// Copies what ComputeRaster gathered into textures and clears the buffers for the next frame. PACKED: as in
// compute_raster.comp.glsl; here as two words.
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = kRasterGroup) in;
layout(std430, binding = kRasterQueueBuffer) buffer Queue { RasterQueueHeader queue; };
#ifdef PACKED
layout(std430, binding = kRasterDepthsBuffer) buffer Depths { uvec2 nearest[]; };
#else
layout(std430, binding = kRasterDepthsBuffer) buffer Depths { uint depths[]; };
#endif
layout(binding = kRasterDepthImage, r32f) uniform writeonly image2D depthImage;
#ifdef IDS
#ifndef PACKED
layout(std430, binding = kRasterIdsBuffer) buffer Ids { uint ids[]; };
#endif
layout(binding = kRasterIdsImage, r32ui) uniform writeonly uimage2D idImage;
#endif
uniform ivec2 sizePx;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (pixel == ivec2(0)) queue.queued = 0u;
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const int at = pixel.y * sizePx.x + pixel.x;
#ifdef PACKED
  const uvec2 found = nearest[at];
  imageStore(depthImage, pixel, vec4(uintBitsToFloat(found.y)));
  imageStore(idImage, pixel, uvec4(~found.x));
  nearest[at] = uvec2(0u);
#else
  imageStore(depthImage, pixel, vec4(uintBitsToFloat(depths[at])));
  depths[at] = 0u;
#ifdef IDS
  imageStore(idImage, pixel, uvec4(ids[at]));
  ids[at] = 0xffffffffu;
#endif
#endif
}
