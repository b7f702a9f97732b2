// SPDX-License-Identifier: BSD-3-Clause
// Visibility in the previous frame by percentage-closer comparison, the larger one of both levels of detail.
#include "perception/popping/gpu/popping_bindings.h"
#include "perception/popping/gpu/previous_place.glsl"

layout(local_size_x = kPoppingGroupX, local_size_y = kPoppingGroupY) in;

layout(binding = kDisocclusionDepthOfPixel0Unit) uniform sampler2D depthOfPixel0;
layout(binding = kDisocclusionDisplacement0Unit) uniform sampler2D displacement0;
layout(binding = kDisocclusionPreviousDepth0Unit) uniform sampler2D previousDepth0;
layout(binding = kDisocclusionDepthOfPixel1Unit) uniform sampler2D depthOfPixel1;
layout(binding = kDisocclusionDisplacement1Unit) uniform sampler2D displacement1;
layout(binding = kDisocclusionPreviousDepth1Unit) uniform sampler2D previousDepth1;
layout(binding = kDisocclusionWeightsImage, r32f) uniform writeonly image2D weights;

uniform int viewCount, pcfRadius;
uniform float depthTolerance, outsideVisibility;

// Background (<= 0) is infinitely far.
bool isSeen(float point, float map) {
  if (!(map > 0.0)) return true;
  if (!(point > 0.0)) return false;
  return point <= map * (1.0 + depthTolerance);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(weights)))) return;
  float largest = 0.0;
  for (int view = 0; view < viewCount; ++view) {
    ivec2 size = view == 0 ? textureSize(previousDepth0, 0) : textureSize(previousDepth1, 0);
    vec2 place = previousPlace(pixel, view == 0 ? texelFetch(displacement0, pixel, 0).xy
                                                : texelFetch(displacement1, pixel, 0).xy);
    if (!isInside(place, size)) {
      largest = max(largest, outsideVisibility);
      continue;
    }
    float depth = view == 0 ? texelFetch(depthOfPixel0, pixel, 0).x : texelFetch(depthOfPixel1, pixel, 0).x;
    float sum = 0.0;
    for (int y = -pcfRadius; y <= pcfRadius; ++y)
      for (int x = -pcfRadius; x <= pcfRadius; ++x) {
        Corners corners = cornersAround(place + vec2(x, y));
        for (int corner = 0; corner < 4; ++corner) {
          ivec2 texel = cornerTexel(corners, corner, size);
          float there = view == 0 ? texelFetch(previousDepth0, texel, 0).x : texelFetch(previousDepth1, texel, 0).x;
          if (isSeen(depth, there)) sum += cornerWeight(corners, corner);
        }
      }
    float taps = float((2 * pcfRadius + 1) * (2 * pcfRadius + 1));
    largest = max(largest, clamp(sum / taps, 0.0, 1.0));
  }
  imageStore(weights, pixel, vec4(largest));
}
