// SPDX-License-Identifier: BSD-3-Clause
// Depth that a texel of a level stands for: the nearest of the finest texels that it covers (Schwarz 2009, section 4.1) or,
// with DEPTHS_SAMPLED, that of one of them, so that on average it covers as much of the light as they do.
#ifdef DEPTHS_SAMPLED
#include "renderer/frame/sampled_texel.glsl"
#if MAP_LAYERS > 1
layout(binding = kSampledDepthsUnit) uniform sampler2DArray sampledDepths;
float sampledDepth(ivec2 place) { return texelFetch(sampledDepths, ivec3(place, mapLayer), 0).x; }
#else
layout(binding = kSampledDepthsUnit) uniform sampler2D sampledDepths;
float sampledDepth(ivec2 place) { return texelFetch(sampledDepths, place, 0).x; }
#endif

float levelDepth(ivec2 texel, int level) {
  return level == 0 ? minimumDepth(texel, 0)
                    : sampledDepth(sampledPlace(texel, level, resolution));
}
// Where that depth was found, in texels of level 0.
vec2 depthPlace(ivec2 texel, int level) { return vec2(sampledTexel(texel, level)) + 0.5; }
// Texels of level 0 to either side that it may have been found at instead.
#ifdef DEPTHS_MEDIAN
float depthSpread(int level) { return 0.5 * float((1 << level) - 1); }
#else
float depthSpread(int level) { return 0.0; }
#endif
#else
float levelDepth(ivec2 texel, int level) { return minimumDepth(texel, level); }
vec2 depthPlace(ivec2 texel, int level) { return (vec2(texel) + 0.5) * float(1 << level); }
float depthSpread(int level) { return 0.5 * float((1 << level) - 1); }
#endif
