// SPDX-License-Identifier: BSD-3-Clause
// Mean of visibility over neighbours along one axis, see visibility_filter.h.
#include "renderer/techniques/soft_shadows/bitmask/bitmask_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kVisibilityFilterReceiversUnit) uniform sampler2D receivers;
layout(binding = kVisibilityFilterVisibilitiesUnit) uniform sampler2D visibilities;
layout(binding = kVisibilityFilterPositionsUnit) uniform sampler2D positions;
layout(binding = kVisibilityFilterNormalsUnit) uniform sampler2D normals;
layout(binding = kVisibilityFilterVisibilityImage, r32f) uniform writeonly image2D outVisibility;

uniform ivec2 sizePx, direction;
uniform int radius;
uniform float maxStep, planeShare, normalCosine;

bool onSameSurface(vec3 position, vec3 normal, ivec2 other) {
  if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, sizePx))) return false;
  if (texelFetch(receivers, other, 0).w < 0.0) return false;
  if (dot(normal, texelFetch(normals, other, 0).xyz) < normalCosine) return false;
  const vec3 across = texelFetch(positions, other, 0).xyz - position;
  return abs(dot(normal, across)) <= planeShare * length(across);
}

// Neighbours that belong to the pixel, going by `step`.
int walk(ivec2 pixel, ivec2 step, float visibility) {
  const vec3 position = texelFetch(positions, pixel, 0).xyz, normal = texelFetch(normals, pixel, 0).xyz;
  float last = visibility;
  for (int i = 1; i <= radius; ++i) {
    const ivec2 other = pixel + i * step;
    if (!onSameSurface(position, normal, other)) return i - 1;
    const float next = texelFetch(visibilities, other, 0).x;
    if (!(abs(next - last) <= maxStep)) return i - 1;
    last = next;
  }
  return radius;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const float visibility = texelFetch(visibilities, pixel, 0).x;
  float sum = visibility;
  int count = 0;
  if (texelFetch(receivers, pixel, 0).w >= 0.0)
    count = min(walk(pixel, direction, visibility), walk(pixel, -direction, visibility));
  for (int i = 1; i <= count; ++i)
    sum += texelFetch(visibilities, pixel + i * direction, 0).x + texelFetch(visibilities, pixel - i * direction, 0).x;
  imageStore(outVisibility, pixel, vec4(sum / float(2 * count + 1)));
}
