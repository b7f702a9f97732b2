// SPDX-License-Identifier: BSD-3-Clause
// All levels of a sampled pyramid at once, into its atlas: each invocation finds the level and texel that it stands for.
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/sampled_texel.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSampledPyramidMapUnit) uniform sampler2D shadowMap;  // linear
layout(binding = kSampledPyramidImage, r32f) uniform writeonly image2D outAtlas;
uniform int resolution;

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (at.y >= resolution) return;
  const int level = findMSB(2 * resolution / (resolution - at.y));
  const ivec2 texel = at - sampledPlace(ivec2(0), level, resolution);
  if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(resolution >> level)))) return;
#ifdef DEPTHS_MEDIAN
  // The second nearest of four, one in each quarter.
  vec4 z;
  for (int i = 0; i < 4; ++i) z[i] = texelFetch(shadowMap, latticeTexel(2 * texel + ivec2(i & 1, i >> 1), level - 1), 0).x;
  const vec2 nearer = min(z.xy, z.zw), farther = max(z.xy, z.zw);
  imageStore(outAtlas, at, vec4(min(max(nearer.x, nearer.y), min(farther.x, farther.y))));
#else
  imageStore(outAtlas, at, texelFetch(shadowMap, sampledTexel(texel, level), 0));
#endif
}
