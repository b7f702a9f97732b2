// SPDX-License-Identifier: BSD-3-Clause
// One band's thresholds at full size, interpolated bilinearly.
#include "perception/band_thresholds/band_threshold_bindings.h"

layout(local_size_x = kBandReduceX, local_size_y = kBandReduceY) in;
layout(binding = kBandEnlargeSourceUnit) uniform sampler2D source;
layout(binding = kBandEnlargeImage, r32f) uniform writeonly image2D enlarged;
uniform int level;
uniform ivec2 origin;

void main() {
  ivec2 at = origin + ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(enlarged)))) return;
  ivec2 last = textureSize(source, level) - 1, first = at >> level;
  vec2 t = vec2(at - (first << level)) / float(1 << level);
  ivec2 second = min(first + 1, last);
  first = min(first, last);
  float above = mix(texelFetch(source, first, level).r, texelFetch(source, ivec2(second.x, first.y), level).r, t.x);
  float below = mix(texelFetch(source, ivec2(first.x, second.y), level).r, texelFetch(source, second, level).r, t.x);
  imageStore(enlarged, at, vec4(mix(above, below, t.y)));
}
