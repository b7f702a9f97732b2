// SPDX-License-Identifier: BSD-3-Clause
// One place in every pixel and `lobes` directions from the mirror seen there, added to the sum of all places. See
// distribution_traced.cpp.
#include "renderer/references/reference_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kDistributionSumImage, rgba32f) uniform image2D sum;

uniform ivec2 sizePx;
uniform int bounces, shadows, lobes, placesAside, place;
uniform float leastShare, placeWeight;
uniform uint seed;
uniform bool seenShadow;
#ifdef PHONG
uniform float logOfRim;  // of the lobe's value at the cone's border, relative to its axis; < 0
#endif
#include "renderer/frame/mirror_trace.glsl"

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

// In [0, 1).
vec2 uniformPair(uvec2 bits) { return vec2(bits >> 8u) / 16777216.0; }

// Share 1 - cosine of a direction in a cone about the mirrored direction.
float sampledVersine(float u, float halfAngle) {
#ifdef PHONG
  // The lobe is cos^n, n such that it is `rim` at the border; its inverse in log(cosine), by a series where that is small.
  const float n = logOfRim / log(max(cos(halfAngle), 1e-4));
  const float depth = -log(1.0 - u * (1.0 - exp(logOfRim * (n + 1.0) / n))) / (n + 1.0);
  return depth < 0.02 ? depth * (1.0 - depth * (0.5 - depth / 6.0)) : 1.0 - exp(-depth);
#else
  const float s = sin(0.5 * halfAngle);
  return 2.0 * s * s * u;
#endif
}

vec3 inCone(vec3 axis, float halfAngle, vec2 u) {
  const float versine = sampledVersine(u.x, halfAngle);
  const vec3 side = normalize(cross(axis, abs(axis.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
  const float angle = 6.28318531 * u.y, sine = sqrt(max(versine * (2.0 - versine), 0.0));
  return normalize((1.0 - versine) * axis + sine * (cos(angle) * side + sin(angle) * cross(axis, side)));
}

// Light along one path from a mirror, and whether its first direction leads away from the surface.
vec3 pathColour(SurfacePoint point, vec3 seenShare, vec2 first, uvec4 key, out bool leaves) {
  vec3 result = vec3(0.0), share = vec3(1.0);
  vec2 u = first;
  leaves = true;
  for (int bounce = 0; bounce < bounces; ++bounce) {
    const vec3 adds = share * seenShare;
    if (max(adds.r, max(adds.g, adds.b)) <= leastShare) break;
    const SurfaceMaterial mirror = surfaceMaterials[surfaceMaterialOf[point.triangle]];
    vec3 direction = mirrored(point.view, point.normal, point.flatNormal);
    if (mirror.glossRad > 0.0) {
      direction = inCone(direction, mirror.glossRad, u);
      if (!(dot(direction, point.flatNormal) > 0.0)) {
        // The first bounce leaves the direction out; a later one takes the mirrored direction itself.
        if (bounce == 0) {
          leaves = false;
          return vec3(0.0);
        }
        direction = mirrored(point.view, point.normal, point.flatNormal);
      }
    }
    const Ray ray = rayFrom(point, direction);
    const RayHit hit = rayClosestHit(ray);
    if (hit.triangle == kRayNoTriangle) return result + share * background;
    point = hitPoint(ray, hit);
    result += share * hitColour(point, bounce < shadows);
    const SurfaceMaterial next = surfaceMaterials[surfaceMaterialOf[hit.triangle]];
    share *= mirrorShare(next.mirror, next.fresnel != 0u, dot(point.view, point.normal));
    u = uniformPair(hashed(key + uvec4(0u, 0u, 0u, uint(bounce) + 1u)).xy);
  }
  return result;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint number = uint(pixel.y * sizePx.x + pixel.x);
  const uvec4 own = hashed(uvec4(number, uint(place), seed, 0u));
  const vec2 jitter =
      (vec2(place % placesAside, place / placesAside) + uniformPair(own.xy)) / float(placesAside);
  const vec3 forward = mat3(cameraToAnchor) * placeRay(vec2(pixel) + jitter, rayScale, sizePx);
  const Ray seen = Ray(eye, normalize(forward), 0.0, kRayFarthest, kRayNoTriangle);
  const RayHit hit = rayClosestHit(seen);
  vec3 colour = background;
  if (hit.triangle != kRayNoTriangle) {
    const SurfacePoint point = hitPoint(seen, hit);
    colour = hitColour(point, seenShadow);
    const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[hit.triangle]];
    if (material.mirror != vec3(0.0)) {
      const vec3 share = mirrorShare(material.mirror, material.fresnel != 0u, dot(point.view, point.normal));
      const int count = material.glossRad > 0.0 ? lobes : 1;
      const vec2 shift = uniformPair(own.zw);
      vec3 found = vec3(0.0);
      int used = 0;
      for (int i = 0; i < count; ++i) {
        ++rayIterations;
        const vec2 u = fract(shift + vec2((float(i) + 0.5) / float(count), float(bitfieldReverse(uint(i)) >> 8u) / 16777216.0));
        bool leaves;
        const vec3 along = pathColour(point, share, u, uvec4(number, uint(place), seed, uint(i + 1) << 8u), leaves);
        if (leaves) found += along, ++used;
      }
      if (used > 0) colour += share * found / float(used);
    }
  }
  if (rayCutShort) colour = vec3(uintBitsToFloat(0x7fc00000u));
  imageStore(sum, pixel, vec4(imageLoad(sum, pixel).rgb + placeWeight * colour, 1.0));
}
