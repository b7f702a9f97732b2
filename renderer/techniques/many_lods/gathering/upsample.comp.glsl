// SPDX-License-Identifier: BSD-3-Clause
// What receivers have gathered, for all pixels: of the four around a pixel, weighted by their place, and by how well normal and plane
// agree with the pixel's. LIGHT: times the surface's albedo, and what its lobe reflects.
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(std430, binding = kGatheredBuffer) readonly buffer Gathered { vec4 gathered[]; };
layout(binding = kGatherPositionsUnit) uniform sampler2D positions;
layout(binding = kGatherNormalsUnit) uniform sampler2D normals;
#ifdef LIGHT
layout(binding = kGatherAlbedosUnit) uniform sampler2D albedos;
#endif
layout(binding = kGatherImage, rgba32f) uniform writeonly image2D picture;

uniform ivec2 sizePx, gridSize;
uniform int spacing;
#ifdef LIGHT
uniform float glossShare;
#endif
uniform float normalPower, planeTolerance;  // world units

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 position = texelFetch(positions, pixel, 0);
  if (position.w == 0.0) {
#ifdef LIGHT
    imageStore(picture, pixel, vec4(0.0, 0.0, 0.0, 1.0));
#else
    imageStore(picture, pixel, vec4(1.0));
#endif
    return;
  }
  const vec3 normal = texelFetch(normals, pixel, 0).xyz;
  const vec2 at = (vec2(pixel) - float(spacing / 2)) / float(spacing);
  const ivec2 first = ivec2(floor(at));
  const vec2 part = at - vec2(first);
  vec3 sum = vec3(0.0), nearest = vec3(0.0);
#ifdef LIGHT
  const vec3 albedo = (1.0 - glossShare) * texelFetch(albedos, pixel, 0).rgb;
#endif
  float total = 0.0, best = -1.0;
  for (int i = 0; i < 4; ++i) {
    const ivec2 offset = ivec2(i & 1, i >> 1);
    const ivec2 cell = clamp(first + offset, ivec2(0), gridSize - 1);
    const ivec2 from = min(cell * spacing + spacing / 2, sizePx - 1);
    const vec4 there = texelFetch(positions, from, 0);
    if (there.w == 0.0) continue;
    vec3 value = gathered[cell.y * gridSize.x + cell.x].rgb;
#ifdef LIGHT
    value = value * albedo + gathered[gridSize.x * gridSize.y + cell.y * gridSize.x + cell.x].rgb;
#endif
    const vec2 place = mix(1.0 - part, part, vec2(offset));
    const float agreement = pow(max(dot(normal, texelFetch(normals, from, 0).xyz), 0.0), normalPower) *
                            exp(-abs(dot(normal, there.xyz - position.xyz)) / planeTolerance);
    const float weight = place.x * place.y * agreement;
    sum += weight * value;
    total += weight;
    if (agreement > best) best = agreement, nearest = value;
  }
  imageStore(picture, pixel, vec4(total > 1e-4 ? sum / total : nearest, 1.0));
}
