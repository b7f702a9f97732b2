// SPDX-License-Identifier: BSD-3-Clause
// What a prefiltered map holds of each depth.
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/prefiltered_map.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kPrefilteredDepthsUnit) uniform sampler2D depths;
#ifdef SUMS_FIXED
layout(binding = kPrefilteredImage, TEXEL) uniform writeonly uimage2DArray outValues;
uniform float sumsUnit;
#else
layout(binding = kPrefilteredImage, TEXEL) uniform writeonly image2DArray outValues;
#endif
uniform int resolution;

void store(ivec2 at, int layer, vec2 value) {
#ifdef SUMS_FIXED
#ifdef BASIS_FOURIER
  value = 0.5 * value + 0.5;
#endif
  imageStore(outValues, ivec3(at, layer), uvec4(uvec2(clamp(value, 0.0, 1.0) / sumsUnit + 0.5), 0u, 0u));
#else
  imageStore(outValues, ivec3(at, layer), vec4(value, 0.0, 0.0));
#endif
}

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (max(at.x, at.y) >= resolution) return;
  const float d = normalisedDepth(texelFetch(depths, at, 0).x);
#ifdef BASIS_MOMENTS
  store(at, 0, vec2(d, d * d));
#elif defined(BASIS_EXPONENTIAL)
  store(at, 0, vec2(exp(exponent * (d - kUnitDepth)), 0.0));
#else
  for (int k = 0; k < terms; ++k) {
    const vec2 term = fourierTerm(k, periodShare * d);
    store(at, k, term);
#ifdef WITH_DEPTHS
    store(at, terms + k, d * term);
#endif
  }
#ifdef WITH_DEPTHS
  store(at, 2 * terms, vec2(d, 0.0));
#endif
#endif
}
