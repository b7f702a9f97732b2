// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/shadow_depth.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D depthMap;
layout(binding = 0, r32f) uniform writeonly image2D linearMap;
uniform float near;
uniform int resolution;

void main() {
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, ivec2(resolution)))) return;
  imageStore(linearMap, texel, vec4(linearDepth(texelFetch(depthMap, texel, 0).x, near)));
}
