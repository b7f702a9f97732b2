// SPDX-License-Identifier: BSD-3-Clause
// Mean along one axis over TILE pixels of the same surface, by depth and normal. Two such passes average every direction
// of a tile once. The second writes the picture.
#include "renderer/techniques/ambient_occlusion/occlusion_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kOcclusionPackedUnit) uniform sampler2D packedIn;
#ifdef LAST
layout(binding = kOcclusionOutImage, rgba32f) uniform writeonly image2D outImage;
#else
layout(binding = kOcclusionPackedImage, rgba32f) uniform writeonly image2D outPacked;
#endif
uniform ivec2 sizePx;
uniform ivec2 axis;
uniform vec2 rayScale;
uniform float depthTolerance;  // distance from the pixel's plane, as a share of its depth, at which weights are 1/e

vec3 rayAt(ivec2 pixel) {
  const vec2 ndc = vec2(2.0, -2.0) * (vec2(pixel) + 0.5) / vec2(sizePx) + vec2(-1.0, 1.0);
  return vec3(ndc * rayScale, -1.0);
}
vec3 normalOf(vec4 texel) { return vec3(texel.zw, sqrt(max(0.0, 1.0 - dot(texel.zw, texel.zw)))); }

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  vec4 here = texelFetch(packedIn, pixel, 0);
  if (here.y > 0.0) {
    const vec3 normal = normalOf(here), position = rayAt(pixel) * here.y;
    float sum = 0.0, weights = 0.0;
    for (int i = 0; i < TILE; ++i) {
      const ivec2 at = pixel + (i - TILE / 2) * axis;
      if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, sizePx))) continue;
      const vec4 other = texelFetch(packedIn, at, 0);
      if (other.y == 0.0) continue;
      const float off = dot(normal, rayAt(at) * other.y - position) / (depthTolerance * here.y);
      const float alike = max(dot(normal, normalOf(other)), 0.0), square = alike * alike;
      const float weight = exp(-off * off) * square * square;
      sum += weight * other.x;
      weights += weight;
    }
    if (weights > 0.0) here.x = sum / weights;
  }
#ifdef LAST
  imageStore(outImage, pixel, vec4(here.xxx, 1.0));
#else
  imageStore(outPacked, pixel, here);
#endif
}
