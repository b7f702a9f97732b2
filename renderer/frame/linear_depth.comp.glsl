// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/shadow_depth.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kLinearDepthSourceUnit) uniform sampler2D depthMap;
layout(binding = kLinearDepthImage, r32f) uniform writeonly image2D linearMap;
uniform float near;
uniform int resolution;

void main() {
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, ivec2(resolution)))) return;
  imageStore(linearMap, texel, vec4(linearDepth(texelFetch(depthMap, texel, 0).x, near)));
}
