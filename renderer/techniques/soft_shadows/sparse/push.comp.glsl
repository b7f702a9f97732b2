// SPDX-License-Identifier: BSD-3-Clause
// Push: each pixel without a visibility of its own takes it from the pyramid, from the level of its own spacing on until
// what it found weighs 1. Interpolated straight at the pixel instead of level by level, so that each pixel decides by its own
// surface what it takes; Schwarz 2009, section 5.1.3, names the reconstruction without details. Weights are a tent as wide
// as a texel's side about the place that the texel's samples have, not about the texel's middle: samples at regular
// distances then interpolate linearly, wherever in their texels they lie.
#include "renderer/techniques/soft_shadows/sparse/sparse_bindings.h"
#include "renderer/frame/seen_point.glsl"
#include "renderer/techniques/soft_shadows/sparse/reconstructed_pixel.glsl"
#include "renderer/techniques/soft_shadows/sparse/surface_weight.glsl"

layout(binding = kSparsePushSlotsUnit) uniform usampler2D slots;
layout(binding = kSparsePushSampledVisibilityUnit) uniform sampler2D sampledVisibility;
layout(binding = kSparsePushPulledPointsUnit) uniform sampler2D pulledPoints;
layout(binding = kSparsePushPulledWeightsUnit) uniform sampler2D pulledWeights;
uniform int pulledLevels;

const float kEnough = 0.999;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  if (texelFetch(receivers, pixel, 0).w < 0.0) {
    store(pixel, 1.0, kClassNoReceiver);
    return;
  }
  const uint slot = texelFetch(slots, pixel, 0).x;
  if ((slot & kSkippedSlot) == 0u) {
    store(pixel, texelFetch(sampledVisibility, ivec2(slot & 0xffffu, slot >> 16), 0).x, kClassOwnSample);
    return;
  }
  const vec3 point = pixelRay(pixel, rayScale, sizePx) * texelFetch(depths, pixel, 0).x;
  const vec3 normal = cameraNormal(texelFetch(normals, pixel, 0));
  const vec2 place = vec2(pixel) + 0.5;
  float visibility = 0.0, found = 0.0, nearest = 1e38, nearestVisibility = 1.0;
  // Texels of the pyramid's finest level are two pixels wide: the spacing of level 1. A pixel of level 0 is always chosen.
  for (int level = max(int(slot & ~kSkippedSlot) - 1, 0); level < pulledLevels && found < kEnough; ++level) {
    const ivec2 last = textureSize(pulledWeights, level) - 1, middle = pixel >> (level + 1);
    const float side = float(2 << level);
    float sum = 0.0, total = 0.0;
    for (int y = max(middle.y - 1, 0); y <= min(middle.y + 1, last.y); ++y)
      for (int x = max(middle.x - 1, 0); x <= min(middle.x + 1, last.x); ++x) {
        const float held = texelFetch(pulledWeights, ivec2(x, y), level).x;
        if (held <= 0.0) continue;
        const vec4 other = texelFetch(pulledPoints, ivec2(x, y), level);
        const vec2 ndc = other.xy / (-other.z * rayScale);
        const vec2 apart = abs((ndc * vec2(0.5, -0.5) + 0.5) * vec2(sizePx) - place) / side;
        const float tent = max(1.0 - apart.x, 0.0) * max(1.0 - apart.y, 0.0);
        const float weight = tent * held * depthWeight(planeDistance(point, normal, other.xyz));
        sum += weight * other.w;
        total += weight;
        const float apartInDepth = abs(other.z - point.z);
        if (apartInDepth < nearest) {
          nearest = apartInDepth;
          nearestVisibility = other.w;
        }
      }
    // What a level gives fills what finer levels left open.
    const float share = 1.0 - found;
    if (total > 0.0) visibility += share * min(total, 1.0) * (sum / total);
    found += share * min(total, 1.0);
  }
  if (found > kLeastWeight)
    store(pixel, clamp(visibility / found, 0.0, 1.0), kClassInterpolated);
  else
    store(pixel, nearestVisibility, nearest < 1e38 ? kClassNearestInDepth : kClassNoSample);
}
