// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of images too small for a frequency band: a share of the luminance adapted to.
#include "perception/band_thresholds/light.glsl"

layout(local_size_x = kBandReduceX, local_size_y = kBandReduceY) in;
layout(binding = kBandReduceSourceUnit) uniform sampler2D source;
layout(binding = kBandCombinedImage, r32f) uniform writeonly image2D combined;
uniform int adaptationLevel;
uniform vec3 taps;
uniform float epsilon, share, fixedLuminance;

// At most 3 x 3 pixels wide or high on one side, so that a level is at most one step away.
float tap(int k) { return k == 0 ? taps.z : abs(k) == 1 ? taps.y : taps.x; }

float adapted(ivec2 at, ivec2 size) {
#if FIXED_ADAPTATION
  return fixedLuminance;
#else
  if (adaptationLevel == 0) return luminanceOf(texelFetch(source, at, 0));
  ivec2 coarse = max(size / 2, ivec2(1)), first = min(at >> 1, coarse - 1), second = min((at >> 1) + 1, coarse - 1);
  vec2 t = 0.5 * vec2(at & 1);
  float sums[4];
  for (int i = 0; i < 4; ++i) {
    ivec2 centre = 2 * ivec2((i & 1) == 0 ? first.x : second.x, (i & 2) == 0 ? first.y : second.y);
    sums[i] = 0.0;
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx)
        sums[i] += tap(dx) * tap(dy) *
                   luminanceOf(texelFetch(source, clamp(centre + ivec2(dx, dy), ivec2(0), size - 1), 0));
  }
  return mix(mix(sums[0], sums[1], t.x), mix(sums[2], sums[3], t.x), t.y);
#endif
}

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(combined);
  if (any(greaterThanEqual(at, size))) return;
  imageStore(combined, at, vec4(share * max(adapted(at, size), epsilon)));
}
