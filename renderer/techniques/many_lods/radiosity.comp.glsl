// SPDX-License-Identifier: BSD-3-Clause
// Light that virtual point lights send to what the camera sees, and that it reflects. TRACED: seen along rays; else as the tiles of
// their views have it.
#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"
#include "renderer/ray_tracing/ray_tracing_bindings.h"
#ifdef TRACED
#include "renderer/ray_tracing/trace.glsl"
#endif

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(std430, binding = kRadiosityLightsBuffer) readonly buffer Lights { VirtualLight lights[]; };
#ifndef TRACED
layout(std430, binding = kRadiosityViewsBuffer) readonly buffer Views { CutView views[]; };
layout(std430, binding = kRadiosityDepthsBuffer) readonly buffer Depths { uint depths[]; };
#endif
#ifdef IN_PLACE
layout(std430, binding = kRadiosityCountsBuffer) readonly buffer Counts { InPlaceCounts counts; };
#endif
layout(binding = kRadiosityPositionsUnit) uniform sampler2D positions;
layout(binding = kRadiosityNormalsUnit) uniform sampler2D normals;
layout(binding = kRadiosityAlbedosUnit) uniform sampler2D albedos;
layout(binding = kRadiosityIdsUnit) uniform usampler2D triangleIds;
layout(binding = kRadiosityImage, rgba32f) uniform writeonly image2D picture;

uniform ivec2 sizePx;
uniform uint lightCount;
uniform float leastDistance2;
uniform float depthBias;  // world units
uniform float slopeBias;  // share of the distance, for a surface at 45 degrees
uniform int side;         // of a tile, px

shared VirtualLight batch[kRadiosityBatch];

#ifdef TRACED
uint lightTriangle = 0u;
bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) { return hit.triangle != lightTriangle; }

float seen(uint number, VirtualLight light, vec3 position, vec3 normal, uint triangle) {
  lightTriangle = floatBitsToUint(light.normal.w);
  const vec3 path = light.position.xyz - position;
  // Both ends lie on surfaces: what is within a ten-thousandth of either is no occluder.
  return rayAnyHit(Ray(position, path, 1e-4, 1.0 - 1e-4, triangle)) ? 0.0 : 1.0;
}
#else
float seen(uint number, VirtualLight light, vec3 position, vec3 normal, uint triangle) {
  const CutView view = views[number];
  const vec3 v = position - view.eye.xyz;
  const float distance_ = length(v);
  const float depth = dot(v, view.axisZ.xyz);
  if (!(depth > -0.5 * distance_)) return 1.0;
  const vec2 at = vec2(dot(v, view.axisX.xyz), dot(v, view.axisY.xyz)) / (distance_ + depth);
  const ivec2 pixel = clamp(ivec2(floor((0.5 + 0.5 * at) * float(side))), ivec2(0), ivec2(side - 1));
  const uint nearest = depths[(number * uint(side) + uint(pixel.y)) * uint(side) + uint(pixel.x)];
  if (nearest == kAtlasEmpty) return 1.0;
  // Discs have one depth: that of a slanted surface differs from it by the tangent of its slope.
  const float cosine = clamp(abs(dot(v, normal)) / max(distance_, 1e-30), 0.0, 1.0);
  const float slope = min(sqrt(1.0 - cosine * cosine) / max(cosine, 1e-3), kRadiosityMostSlope);
  const float bias = depthBias + slopeBias * distance_ * (1.0 + slope);
  return uintBitsToFloat(nearest) < (distance_ - bias) * view.frustum.z ? 0.0 : 1.0;
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  const bool inside = all(lessThan(pixel, sizePx));
  const vec4 position = inside ? texelFetch(positions, pixel, 0) : vec4(0.0);
  const vec3 normal = inside ? texelFetch(normals, pixel, 0).xyz : vec3(0.0);
  const uint triangle = inside ? texelFetch(triangleIds, pixel, 0).x : 0u;
  vec3 sum = vec3(0.0);
  for (uint first = 0u; first < lightCount; first += uint(kRadiosityBatch)) {
    barrier();
    if (gl_LocalInvocationIndex < uint(kRadiosityBatch) && first + gl_LocalInvocationIndex < lightCount)
      batch[gl_LocalInvocationIndex] = lights[first + gl_LocalInvocationIndex];
    barrier();
    if (position.w == 0.0) continue;
    const uint here = min(uint(kRadiosityBatch), lightCount - first);
    for (uint i = 0u; i < here; ++i) {
      const VirtualLight light = batch[i];
      if (light.position.w == 0.0) continue;
      const vec3 path = light.position.xyz - position.xyz;
      const float distance2 = dot(path, path);
      const float cosines = dot(path, normal) * -dot(path, light.normal.xyz);
      if (!(dot(path, normal) > 0.0) || !(cosines > 0.0)) continue;
      const float share = cosines / (distance2 * max(distance2, leastDistance2));
      sum += light.flux.rgb * (share * seen(first + i, light, position.xyz, normal, triangle));
    }
  }
  if (!inside) return;
#ifdef TRACED
  if (rayCutShort) sum = vec3(uintBitsToFloat(0x7fc00000u));
#endif
#ifdef IN_PLACE
  if (counts.unfinished != 0u) sum = vec3(uintBitsToFloat(0x7fc00000u));
#endif
  // A light's intensity is flux cos / pi, a diffuse surface reflects albedo / pi.
  const vec3 albedo = texelFetch(albedos, pixel, 0).rgb;
  imageStore(picture, pixel, vec4(sum * albedo * (0.10132118 * position.w), 1.0));
}
