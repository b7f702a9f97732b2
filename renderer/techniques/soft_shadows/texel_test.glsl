// SPDX-License-Identifier: BSD-3-Clause
// Whether a texel of the map itself blocks a receiver, for techniques that read no level of its pyramid. Needs
// shadow_lookup.glsl.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

#ifdef BIAS_STORED
layout(binding = kTexelBiasesUnit) uniform sampler2D texelBiases;
uniform float storedScale;
#endif

// `z` is the texel's depth, `depth` what it must undercut (biasedDepth()).
bool texelBlocks(float z, ivec2 texel, vec4 p, float depth) {
  if (!(z < depth)) return false;
#ifdef BIAS_PLANE
  return beforePlane(z, vec2(texel) + 0.5, p, p.z * (1.0 - planeMargin(slopeBias)));
#elif defined(BIAS_STORED)
  ++fetchCount;
  return z + storedScale * texelFetch(texelBiases, texel, 0).x < depth;
#else
  return true;
#endif
}
