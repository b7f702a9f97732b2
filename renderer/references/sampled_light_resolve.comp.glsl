// SPDX-License-Identifier: BSD-3-Clause
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D receivers;
layout(binding = 0, r32ui) uniform readonly uimage2D litCounts;
layout(binding = 1, r32f) uniform writeonly image2D visibility;

uniform ivec2 sizePx;
uniform int samples;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const bool receives = texelFetch(receivers, pixel, 0).w >= 0.0;
  imageStore(visibility, pixel, vec4(receives ? float(imageLoad(litCounts, pixel).x) / float(samples) : 1.0));
}
