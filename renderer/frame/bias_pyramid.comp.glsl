// SPDX-License-Identifier: BSD-3-Clause
// Biases and heights of a level from the level below, folded nearest first. Schwarz 2009, section 4.5.4; see bias_map.h.
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kBiasPyramidMinimumMapUnit) uniform sampler2D minimumMap;
layout(binding = kBiasPyramidBiasesUnit) uniform sampler2D biases;
layout(binding = kBiasPyramidImage, rg32f) uniform writeonly image2D outBiases;
uniform int sourceLevel, size;
uniform float tolerance;

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, ivec2(size)))) return;
  vec3 parts[4];  // depth, bias, height
  for (int i = 0; i < 4; ++i) {
    const ivec2 texel = 2 * at + ivec2(i & 1, i >> 1);
    const vec3 part = vec3(texelFetch(minimumMap, texel, sourceLevel).x, texelFetch(biases, texel, sourceLevel).xy);
    // Insertion that leaves those of one depth in their order.
    int place = i;
    while (place > 0 && parts[place - 1].x > part.x) {
      parts[place] = parts[place - 1];
      --place;
    }
    parts[place] = part;
  }
  const float depth = parts[0].x;
  float bias = parts[0].y, height = parts[0].z;
  for (int i = 1; i < 4; ++i) {
    const vec3 farther = parts[i];
    precise float apart = farther.x - depth;
    precise float gap = farther.x - farther.z - (depth + bias);
    if (!(gap <= tolerance * depth)) continue;
    bias = max(apart + farther.y, bias);
    height = max(height, farther.z - apart);
  }
  imageStore(outBiases, at, vec4(bias, height, 0.0, 0.0));
}
