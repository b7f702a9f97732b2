// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/shadow_lookup.glsl"
#include "renderer/techniques/soft_shadows/texel_test.glsl"

layout(binding = kShadowMapUnit) uniform sampler2D shadowMap;

float visibilityOf(vec4 receiver, ivec2 pixel) {
  const vec2 at = mapTexel(receiver.xy / receiver.z);
  pixelClass = kOutside;
  // Written so that a NaN counts as outside.
  if (!(all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(float(resolution)))))) return 1.0;
  pixelClass = kProcessed;
  fetchCount = 1u;
  return texelBlocks(texelFetch(shadowMap, ivec2(at), 0).x, ivec2(at), receiver, biasedDepth(receiver, 0)) ? 0.0 : 1.0;
}
