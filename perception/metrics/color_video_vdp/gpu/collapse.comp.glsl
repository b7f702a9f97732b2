// SPDX-License-Identifier: BSD-3-Clause
// Adds the coarser levels' part of the map to a level's own; the finest becomes 1 - JOD / 10.
#include "perception/metrics/color_video_vdp/gpu/levels.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;

layout(binding = kCvvdpCollapseMapUnit) uniform sampler2D parts;
layout(binding = kCvvdpCollapseMapImage, r32f) uniform writeonly image2D map;

uniform int level;
uniform vec4 jod;  // factor, exponent, where the scale begins to be a power, slope below

vec3 weightsOf(int i) { return i % 2 == 0 ? vec3(0.1, 0.8, 0.1) : vec3(0.0, 0.5, 0.5); }

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = place[level].zw;
  if (any(greaterThanEqual(pixel, size))) return;
  ivec2 coarse = pixel / 2, last = place[level + 1].zw - 1;
  vec3 acrossWeights = weightsOf(pixel.x), downWeights = weightsOf(pixel.y);
  float sum = 0.0;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) {
      ivec2 at = clamp(coarse + ivec2(x, y) - 1, ivec2(0), last);
      sum += acrossWeights[x] * downWeights[y] * texelFetch(parts, place[level + 1].xy + at, 0).x;
    }
  float value = sum + texelFetch(parts, place[level].xy + pixel, 0).x;
  if (level == 0) value = 0.1 * (value > jod.z ? jod.x * pow(value, jod.y) : jod.w * value);
  imageStore(map, place[level].xy + pixel, vec4(value));
}
