// SPDX-License-Identifier: BSD-3-Clause
// A few rays from the point that each pixel sees, added to the sums of all. See ray_gathered.cpp. SKY: light of the environment that
// arrives unhindered; else light of the lamp that the surfaces which rays meet reflect.
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/ray_tracing/random_place.glsl"
#include "renderer/ray_tracing/trace.glsl"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(std430, binding = kSurfaceTriangleMaterialsBuffer) readonly buffer TriangleMaterials { uint surfaceMaterialOf[]; };
layout(std430, binding = kSurfaceMaterialsBuffer) readonly buffer Materials { SurfaceMaterial surfaceMaterials[]; };
layout(binding = kRayGatherPositionsUnit) uniform sampler2D positions;
layout(binding = kRayGatherNormalsUnit) uniform sampler2D normals;
layout(binding = kRayGatherAlbedosUnit) uniform sampler2D albedos;
layout(binding = kRayGatherIdsUnit) uniform usampler2D triangleIds;
// Light of all rays, and the squares of its channels' means.
layout(binding = kRayGatherSumsImage, rgba32f) uniform image2D sums;

uniform ivec2 sizePx;
uniform int firstRay, endRay;
uniform uint seed;
uniform vec3 eyePosition;               // relative to the anchor
uniform vec3 lampCentre, lampZ, intensity;  // along its direction
uniform float nearestHit, leastDistance;    // world units
#include "renderer/techniques/many_lods/glossy.glsl"
#include "renderer/techniques/many_lods/sky.glsl"

bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) { return true; }

vec3 around(vec3 axis, float cosine, float turn) {
  const vec3 side = normalize(cross(axis, abs(axis.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
  const float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  return sine * (cos(turn) * side + sin(turn) * cross(axis, side)) + cosine * axis;
}

// Radiance of the surface that a ray meets, back along it, in the lamp's light: of a point that sends light with the cosine of its
// direction.
vec3 lampReflected(Ray ray, RayHit hit) {
  const uvec3 corners = sceneTriangle(hit.triangle);
  const vec3 a = scenePosition(corners.x), e1 = scenePosition(corners.y) - a, e2 = scenePosition(corners.z) - a;
  const vec3 position = a + hit.u * e1 + hit.v * e2, reach = max(abs(e1), abs(e2));
  const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
  vec3 normal = cross(e1 * unit, e2 * unit);
  if (!(dot(normal, normal) > 0.0)) return vec3(0.0);
  normal = normalize(normal);
  if (dot(normal, ray.direction) > 0.0) normal = -normal;
  const vec3 path = lampCentre - position;
  const float distance_ = length(path);
  if (!(distance_ > 0.0)) return vec3(0.0);
  const float received = dot(path, normal) / distance_, sent = -dot(path, lampZ) / distance_;
  if (!(received > 0.0 && sent > 0.0)) return vec3(0.0);
  if (rayAnyHit(Ray(position, path, 1e-4, 1.0 - 1e-4, hit.triangle))) return vec3(0.0);
  return surfaceMaterials[surfaceMaterialOf[hit.triangle]].albedo * intensity *
         (0.31830989 * received * sent / (distance_ * distance_));
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 position = texelFetch(positions, pixel, 0);
  if (position.w == 0.0) return;
  const vec3 normal = texelFetch(normals, pixel, 0).xyz, albedo = texelFetch(albedos, pixel, 0).rgb;
  const uint triangle = texelFetch(triangleIds, pixel, 0).x;
  const vec3 view = normalize(eyePosition - position.xyz);
  const vec3 mirrored = 2.0 * dot(normal, view) * normal - view;
  const uint number = uint(pixel.y * sizePx.x + pixel.x);
  // A pattern for all pixels, moved by a place of the pixel's own.
  const vec2 start = randomPlace(uvec3(number, seed, 0u));
  const float choice = randomPlace(uvec3(number, seed, 1u)).x;
  // Of rays that follow the lobe.
  const float lobes = glossShare > 0.0 ? mix(0.25, 0.75, glossShare) : 0.0;
  vec4 sum = imageLoad(sums, pixel);
  for (int i = firstRay; i < endRay; ++i) {
    ++rayIterations;
    // R2 of Roberts; the golden ratio for the choice.
    const vec2 at = fract(start + float(i) * vec2(0.75487767, 0.56984029));
    const bool follows = fract(choice + float(i) * 0.61803399) < lobes;
    const float turn = 6.2831853 * at.y;
    const vec3 towards = follows ? around(mirrored, pow(at.x, 1.0 / (glossExponent + 1.0)), turn) : around(normal, sqrt(1.0 - at.x), turn);
    const float cosine = dot(towards, normal);
    vec3 light = vec3(0.0);
    if (cosine > 0.0) {
      float density = (1.0 - lobes) * 0.31830989 * cosine;
      if (lobes > 0.0)
        density += lobes * (glossExponent + 1.0) * 0.15915494 * pow(max(dot(mirrored, towards), 0.0), glossExponent);
      const Ray ray = Ray(position.xyz, towards, nearestHit, kRayFarthest, triangle);
#ifdef SKY
      if (!rayAnyHit(ray)) light = vec3(skyRadiance(towards));
#else
      const RayHit hit = rayClosestHit(ray);
      if (hit.triangle != kRayNoTriangle) {
        const float near = leastDistance > 0.0 ? min(hit.t / leastDistance, 1.0) : 1.0;
        light = near * near * lampReflected(ray, hit);
      }
#endif
      light *= reflectedShare(albedo, normal, view, towards) / density;
    }
    const float mean = (light.r + light.g + light.b) / 3.0;
    sum += vec4(light, mean * mean);
  }
  if (rayCutShort) sum = vec4(uintBitsToFloat(0x7fc00000u));
  imageStore(sums, pixel, sum);
}
