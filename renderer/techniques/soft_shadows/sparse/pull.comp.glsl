// SPDX-License-Identifier: BSD-3-Clause
// Pull: one level of the pyramid from the next finer one. A texel keeps the mean visibility and place of those of its four
// children that lie on one surface, that of the heaviest child, and the sum of their weights, at most 1.
// FIRST: the children are pixels, and weigh 1 where they were chosen.
#include "renderer/techniques/soft_shadows/sparse/sparse_bindings.h"
#include "renderer/frame/seen_point.glsl"
#include "renderer/techniques/soft_shadows/sparse/surface_weight.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
#ifdef FIRST
layout(binding = kSparsePullSlotsUnit) uniform usampler2D slots;
layout(binding = kSparsePullDepthsUnit) uniform sampler2D depths;
layout(binding = kSparsePullSampledVisibilityUnit) uniform sampler2D sampledVisibility;
#else
layout(binding = kSparsePullFinerPointsUnit) uniform sampler2D finerPoints;   // camera-space place, visibility
layout(binding = kSparsePullFinerWeightsUnit) uniform sampler2D finerWeights;
uniform int finerLevel;
#endif
layout(binding = kSparsePullNormalsUnit) uniform sampler2D normals;  // of the pixels
layout(binding = kSparsePullPointsImage, rgba32f) uniform writeonly image2D outPoints;
layout(binding = kSparsePullWeightsImage, r32f) uniform writeonly image2D outWeights;
uniform ivec2 finerSizePx, sizePx, pictureSizePx;
uniform vec2 rayScale;


void readChild(ivec2 child, out vec4 point, out float weight) {
  point = vec4(0.0);
  weight = 0.0;
  if (any(greaterThanEqual(child, finerSizePx))) return;
#ifdef FIRST
  const uint slot = texelFetch(slots, child, 0).x;
  if ((slot & kSkippedSlot) != 0u) return;
  weight = 1.0;
  point = vec4(pixelRay(child, rayScale, pictureSizePx) * texelFetch(depths, child, 0).x,
               texelFetch(sampledVisibility, ivec2(slot & 0xffffu, slot >> 16), 0).x);
#else
  point = texelFetch(finerPoints, child, finerLevel);
  weight = texelFetch(finerWeights, child, finerLevel).x;
#endif
}

void main() {
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, sizePx))) return;
  vec4 points[4];
  float weights[4];
  int seed = 0;
  for (int i = 0; i < 4; ++i) {
    readChild(2 * texel + ivec2(i & 1, i >> 1), points[i], weights[i]);
    if (weights[i] > weights[seed]) seed = i;
  }
  vec4 sum = vec4(0.0);
  float total = 0.0;
  if (weights[seed] > 0.0) {
    // Its normal: of the pixel where the mean of its points appears.
    const vec2 ndc = points[seed].xy / -points[seed].z / rayScale;
    const vec2 place = (ndc * vec2(0.5, -0.5) + 0.5) * vec2(pictureSizePx);
    const ivec2 pixel = clamp(ivec2(floor(place)), ivec2(0), pictureSizePx - 1);
    const vec3 normal = cameraNormal(texelFetch(normals, pixel, 0));
    for (int i = 0; i < 4; ++i) {
      const bool same = i == seed || planeDistance(points[seed].xyz, normal, points[i].xyz) < 1.0;
      if (!same || weights[i] <= 0.0) continue;
      sum += weights[i] * points[i];
      total += weights[i];
    }
    sum /= total;
  }
  imageStore(outPoints, texel, sum);
  imageStore(outWeights, texel, vec4(min(total, 1.0)));
}
