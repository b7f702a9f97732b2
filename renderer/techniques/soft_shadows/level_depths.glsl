// SPDX-License-Identifier: BSD-3-Clause
// Depth that a texel of a level stands for: the nearest of the finest texels that it covers (Schwarz 2009, section 4.1) or,
// with DEPTHS_SAMPLED, that of one of them, so that on average it covers as much of the light as they do.
#ifdef DEPTHS_SAMPLED
#include "renderer/frame/sampled_texel.glsl"
layout(binding = kSampledDepthsUnit) uniform sampler2D sampledDepths;

float levelDepth(ivec2 texel, int level) {
  return level == 0 ? texelFetch(minimumMap, texel, 0).x
                    : texelFetch(sampledDepths, sampledPlace(texel, level, resolution), 0).x;
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
float levelDepth(ivec2 texel, int level) { return texelFetch(minimumMap, texel, level).x; }
vec2 depthPlace(ivec2 texel, int level) { return (vec2(texel) + 0.5) * float(1 << level); }
float depthSpread(int level) { return 0.5 * float((1 << level) - 1); }
#endif
