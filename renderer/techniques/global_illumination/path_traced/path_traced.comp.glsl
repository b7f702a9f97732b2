// SPDX-License-Identifier: BSD-3-Clause
// A few paths over diffuse surfaces from what each pixel sees, added to those before. See path_traced.cpp.
#include "renderer/techniques/global_illumination/global_illumination_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kLightPathIdsUnit) uniform usampler2D triangleIds;
layout(binding = kLightPathRadianceImage, rgba32f) uniform image2D radiance;
layout(binding = kLightPathMomentsImage, rgba32f) uniform image2D moments;

uniform ivec2 sizePx;
uniform int bounces, firstPath, endPath;
uniform float pathWeight;
uniform uint seed;
uniform bool holdsDirect;
#include "renderer/frame/mirror_trace.glsl"

float rayCount = 0.0;

// The hash "pcg4d" (Jarzynski and Olano 2020).
uvec4 hashed(uvec4 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  v ^= v >> 16u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  return v;
}

// With the density cosine / pi about a unit normal; u in [0, 1).
vec3 cosineDirection(vec3 normal, vec2 u) {
  const vec3 side = normalize(cross(normal, abs(normal.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
  const float angle = 6.28318531 * u.y;
  return sqrt(1.0 - u.x) * normal + sqrt(u.x) * (cos(angle) * side + sin(angle) * cross(normal, side));
}

bool showsFront(SurfacePoint point) {
  const uvec3 vertices = sceneTriangle(point.triangle);
  const vec3 a = scenePosition(vertices.x), e1 = scenePosition(vertices.y) - a, e2 = scenePosition(vertices.z) - a;
  const vec3 reach = max(abs(e1), abs(e2));
  const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
  return dot(cross(e1 * unit, e2 * unit), point.view) > 0.0;
}

// What the surface emits, and reflects of the lamp.
vec3 directRadiance(SurfacePoint point) {
#ifdef LIT
  ++rayCount;
#endif
  vec3 sum = hitColour(point, true);
  const vec3 emission = surfaceMaterials[surfaceMaterialOf[point.triangle]].emission;
  if (emission != vec3(0.0) && showsFront(point)) sum += emission;
  return sum;
}

// Light that one path brings to `point` and that is reflected there.
vec3 alongPath(SurfacePoint point, uvec4 key) {
  vec3 sum = vec3(0.0), share = vec3(1.0);
  for (int bounce = 0; bounce < bounces; ++bounce) {
    ++rayIterations;
    share *= patterned(surfaceMaterials[surfaceMaterialOf[point.triangle]], point.position);
    if (share == vec3(0.0)) break;
    key.w = uint(bounce);
    const vec2 u = vec2(hashed(key).xy >> 8u) / 16777216.0;
    const Ray ray = rayFrom(point, cosineDirection(point.flatNormal, u));
    ++rayCount;
    const RayHit hit = rayClosestHit(ray);
    if (hit.triangle == kRayNoTriangle) break;
    point = hitPoint(ray, hit);
    sum += share * directRadiance(point);
  }
  return sum;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  vec4 sum = vec4(0.0, 0.0, 0.0, 1.0), moment = vec4(0.0);
  if (firstPath > 0) {
    sum = imageLoad(radiance, pixel);
    moment = imageLoad(moments, pixel);
  }
  const uint id = texelFetch(triangleIds, pixel, 0).x;
  if (id != 0xffffffffu) {
    SeenPoint seen;
    SurfacePoint point = surfaceSeen(pixel, id, seen);
    const uvec3 vertices = sceneTriangle(id);
    point.position = pointOnTriangle(scenePosition(vertices.x), scenePosition(vertices.y), scenePosition(vertices.z),
                                     point.position);
    if (holdsDirect && firstPath == 0) sum.rgb += directRadiance(point);
    const uint number = uint(pixel.y * sizePx.x + pixel.x);
    for (int path = firstPath; path < endPath; ++path) {
      ++rayIterations;
      const vec3 found = alongPath(point, uvec4(number, uint(path), seed, 0u));
      const float mean = (found.r + found.g + found.b) / 3.0;
      sum.rgb += pathWeight * found;
      moment.xy += vec2(mean, mean * mean);
    }
    if (rayCutShort) sum.rgb = vec3(uintBitsToFloat(0x7fc00000u));
  }
  moment.z += rayCount;
  imageStore(radiance, pixel, sum);
  imageStore(moments, pixel, moment);
}
