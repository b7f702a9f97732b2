// SPDX-License-Identifier: BSD-3-Clause
// One path from the point that each pixel sees, added to the sum of all. See path_traced.cpp.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kPathIdsUnit) uniform usampler2D triangleIds;
// Colours of all paths, and the squares of their channels' means.
layout(binding = kPathSumsImage, rgba32f) uniform image2D sums;

uniform ivec2 sizePx;
uniform int bounces, path;
uniform uint seed;
uniform bool withDirect, withIndirect;
#include "renderer/ray_tracing/random_place.glsl"
#include "renderer/techniques/global_illumination/surface_light.glsl"

// By the cosine about a unit vector (Malley's method).
vec3 cosineDirection(vec3 normal, vec2 u) {
  const vec3 side = normalize(cross(normal, abs(normal.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
  const float radius = sqrt(u.x), angle = 6.28318531 * u.y;
  return radius * (cos(angle) * side + sin(angle) * cross(normal, side)) + sqrt(1.0 - u.x) * normal;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(triangleIds, pixel, 0).x;
  if (id == kRayNoTriangle) return;
  SeenPoint seen;
  SurfacePoint point = surfaceSeen(pixel, id, seen);
  const uint number = uint(pixel.y * sizePx.x + pixel.x);
  vec3 sum = vec3(0.0), share = vec3(1.0);
  int reflections = 0;
  for (int leg = 0; leg <= bounces + MOST_PASSAGES; ++leg) {
    ++rayIterations;
    const vec3 albedo = reflectance(point);
    if (reflections == 0 ? withDirect : withIndirect) sum += share * (emitted(point) + albedo * lampRadiance(point));
    vec3 direction;
    float passes = 0.0;
#ifdef TRANSPARENT
    // Of surfaces that let light through, one of the two ways by chance.
    const vec3 through = materialOf(point).transmittance;
    passes = (through.r + through.g + through.b) / 3.0;
    if (randomPlace(uvec3(number, uint(path), seed * 1009u + uint(2 * leg + 1))).x < passes) {
      share *= through / passes;
      direction = -point.view;
    } else
#endif
    {
      if (reflections == bounces || albedo == vec3(0.0)) break;
      ++reflections;
      share *= albedo / (1.0 - passes);
      direction = cosineDirection(point.flatNormal, randomPlace(uvec3(number, uint(path), seed * 1009u + uint(2 * leg))));
    }
    const Ray ray = rayFrom(point, direction);
    const RayHit hit = rayClosestHit(ray);
    if (hit.triangle == kRayNoTriangle) break;
    point = hitPoint(ray, hit);
  }
  if (rayCutShort) sum = vec3(uintBitsToFloat(0x7fc00000u));
  const float mean = (sum.r + sum.g + sum.b) / 3.0;
  imageStore(sums, pixel, imageLoad(sums, pixel) + vec4(sum, mean * mean));
}
