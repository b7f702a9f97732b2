// SPDX-License-Identifier: BSD-3-Clause
// Mean over the pixels around that show the same surface, in a window in which each place of a tile of interleaved pixels has the
// same weight: of an even side the window has half a pixel more at both ends.
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kFieldPositionUnit) uniform sampler2D positions;
layout(binding = kFieldNormalUnit) uniform sampler2D normals;
layout(binding = kFieldIdsUnit) uniform usampler2D triangleIds;
#ifdef RECEIVERS_ONLY
layout(binding = kFieldReceiversUnit) uniform sampler2D receivers;
#endif
layout(binding = kFieldUnfilteredUnit) uniform sampler2D unfiltered;
layout(binding = kFieldOutImage, OUT_FORMAT) uniform writeonly image2D outImage;
uniform ivec2 sizePx;
uniform int interleave;
uniform float slopeLimit, cosineLimit;

bool counts(ivec2 pixel) {
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, sizePx))) return false;
#ifdef RECEIVERS_ONLY
  if (texelFetch(receivers, pixel, 0).w < 0.0) return false;
#endif
  return texelFetch(triangleIds, pixel, 0).x != 0xffffffffu;
}

// 1: on the plane of the pixel that is filtered; 0: beyond the limits.
float likeness(vec3 position, vec3 normal, ivec2 other) {
  const vec3 away = texelFetch(positions, other, 0).xyz - position;
  const float along = length(away);
  const float slope = along > 0.0 ? abs(dot(away, normal)) / along : 0.0;
  const float cosine = dot(normal, texelFetch(normals, other, 0).xyz);
  return clamp(1.0 - slope / slopeLimit, 0.0, 1.0) * clamp((cosine - cosineLimit) / (1.0 - cosineLimit), 0.0, 1.0);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 own = texelFetch(unfiltered, pixel, 0);
  if (!counts(pixel)) {
    imageStore(outImage, pixel, own);
    return;
  }
  const vec3 position = texelFetch(positions, pixel, 0).xyz, normal = texelFetch(normals, pixel, 0).xyz;
  const int reach = interleave / 2;
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      const ivec2 other = pixel + ivec2(x, y);
      if (!counts(other)) continue;
      float weight = x == 0 && y == 0 ? 1.0 : likeness(position, normal, other);
      if (interleave % 2 == 0) weight *= (abs(x) == reach ? 0.5 : 1.0) * (abs(y) == reach ? 0.5 : 1.0);
      sum += weight * texelFetch(unfiltered, other, 0);
      weights += weight;
    }
  imageStore(outImage, pixel, sum / weights);
}
