// SPDX-License-Identifier: BSD-3-Clause
// Light that virtual lights send to what the camera sees, and that it reflects: of some of the lights, added to what the picture
// holds. TRACED: seen along rays; else as the tiles of their views have it.
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
layout(binding = kRadiosityImage, rgba32f) uniform image2D picture;

uniform ivec2 sizePx;
uniform uint firstLight, lightCount;  // the last one of this pass, and one more
uniform vec3 eyePosition;              // relative to the anchor
uniform float leastDistance2;
uniform float depthBias;  // world units
uniform float slopeBias;  // share of the distance, for a surface at 45 degrees
uniform int side;         // of a tile, px
uniform float distantNear;  // distance from a surface within which nothing hides distant lights, world units

#include "renderer/techniques/many_lods/glossy.glsl"

shared VirtualLight batch[kRadiosityBatch];

#ifdef TRACED
uint lightTriangle = 0u;
bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) { return hit.triangle != lightTriangle; }

float seen(uint number, VirtualLight light, vec3 position, vec3 normal, uint triangle) {
  ++rayIterations;
  // Both ends lie on surfaces: what is within a ten-thousandth of either is no occluder.
  if (light.position.w == kLightPoint) {
    lightTriangle = floatBitsToUint(light.normal.w);
    return rayAnyHit(Ray(position, light.position.xyz - position, 1e-4, 1.0 - 1e-4, triangle)) ? 0.0 : 1.0;
  }
  lightTriangle = triangle;
  return rayAnyHit(Ray(position, light.position.xyz, distantNear, kRayFarthest, triangle)) ? 0.0 : 1.0;
}
#else
float seen(uint number, VirtualLight light, vec3 position, vec3 normal, uint triangle) {
  const CutView view = views[number];
  const vec3 v = position - view.eye.xyz;
  const float distance_ = length(v);
  const vec3 along = vec3(dot(v, view.axisX.xyz), dot(v, view.axisY.xyz), dot(v, view.axisZ.xyz));
  vec2 at;
  float own;
  if (view.axisZ.w == float(kViewHemisphere)) {
    if (!(along.z > -0.5 * distance_)) return 1.0;
    at = along.xy / (distance_ + along.z);
    own = distance_;
  } else {
    at = along.xy / (along.z * vec2(view.axisX.w, view.axisY.w));
    if (!(along.z > 0.0) || any(greaterThan(abs(at), vec2(1.0)))) return 1.0;
    own = along.z;
  }
  const ivec2 pixel = clamp(ivec2(floor((0.5 + 0.5 * at) * float(side))), ivec2(0), ivec2(side - 1));
  const uint nearest = depths[(number * uint(side) + uint(pixel.y)) * uint(side) + uint(pixel.x)];
  if (nearest == kAtlasEmpty) return 1.0;
  // A pixel has the depth of its middle, or of a disc's: that of a slanted surface differs from it by the tangent of its slope.
  const float cosine = clamp(abs(dot(v, normal)) / max(distance_, 1e-30), 0.0, 1.0);
  const float slope = min(sqrt(1.0 - cosine * cosine) / max(cosine, 1e-3), kRadiosityMostSlope);
  const float bias = depthBias + slopeBias * distance_ * (1.0 + slope);
  return uintBitsToFloat(nearest) < (own - bias) * view.frustum.z ? 0.0 : 1.0;
}
#endif

// Irradiance of a white surface that faces the light, and the unit vector towards it.
vec3 arriving(VirtualLight light, vec3 position, out vec3 towards) {
  if (light.position.w == kLightDistant) {
    towards = light.position.xyz;
    return light.flux.rgb;
  }
  const vec3 path = light.position.xyz - position;
  const float distance2 = dot(path, path);
  towards = path * inversesqrt(max(distance2, 1e-37));
  // Its intensity is flux cos / pi.
  return light.flux.rgb * (0.31830989 * max(-dot(towards, light.normal.xyz), 0.0) / max(distance2, leastDistance2));
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  const bool inside = all(lessThan(pixel, sizePx));
  const vec4 position = inside ? texelFetch(positions, pixel, 0) : vec4(0.0);
  const vec3 normal = inside ? texelFetch(normals, pixel, 0).xyz : vec3(0.0);
  const vec3 albedo = inside ? texelFetch(albedos, pixel, 0).rgb : vec3(0.0);
  const uint triangle = inside ? texelFetch(triangleIds, pixel, 0).x : 0u;
  const vec3 view = normalize(eyePosition - position.xyz);
  vec3 sum = vec3(0.0);
  for (uint first = firstLight; first < lightCount; first += uint(kRadiosityBatch)) {
    barrier();
    if (gl_LocalInvocationIndex < uint(kRadiosityBatch) && first + gl_LocalInvocationIndex < lightCount)
      batch[gl_LocalInvocationIndex] = lights[first + gl_LocalInvocationIndex];
    barrier();
    if (position.w == 0.0) continue;
    const uint here = min(uint(kRadiosityBatch), lightCount - first);
    for (uint i = 0u; i < here; ++i) {
      const VirtualLight light = batch[i];
      if (light.position.w == kLightNone) continue;
      vec3 towards;
      const vec3 irradiance = arriving(light, position.xyz, towards);
      const vec3 share = reflectedShare(albedo, normal, view, towards) * irradiance;
      if (!(share.r + share.g + share.b > 0.0)) continue;
      sum += share * seen(first + i, light, position.xyz, normal, triangle);
    }
  }
  if (!inside) return;
#ifdef TRACED
  if (rayCutShort) sum = vec3(uintBitsToFloat(0x7fc00000u));
#endif
#ifdef IN_PLACE
  if (counts.unfinished != 0u) sum = vec3(uintBitsToFloat(0x7fc00000u));
#endif
  const vec3 before = firstLight == 0u ? vec3(0.0) : imageLoad(picture, pixel).rgb;
  imageStore(picture, pixel, vec4(before + sum * position.w, 1.0));
}
