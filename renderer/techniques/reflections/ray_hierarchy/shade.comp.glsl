// SPDX-License-Identifier: BSD-3-Clause
// What the rays of one bounce bring, and the rays that leave the surfaces they met. See ray_hierarchy.cpp.
uniform ivec2 sizePx;
#include "renderer/frame/mirrored.glsl"
#include "renderer/frame/refracted.glsl"
#include "renderer/frame/shading.glsl"
#include "renderer/techniques/reflections/ray_hierarchy/meet.glsl"
#include "renderer/techniques/reflections/seen_share.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
#ifdef POINTS
layout(std430, binding = kHierarchyHitsBuffer) buffer Hits { NearestHit hits[]; };
#else
layout(std430, binding = kHierarchyHitsBuffer) readonly buffer Hits { NearestHit hits[]; };
#endif
layout(binding = kHierarchySeenUnit) uniform sampler2D seenDirections;
layout(binding = kHierarchySeenIdsUnit) uniform usampler2D seenIds;
layout(binding = kHierarchySumsImage, rgba32f) uniform image2D sums;
layout(binding = kHierarchySharesImage, rgba32f) uniform image2D shares;
layout(binding = kHierarchyNextOriginsImage, rgba32f) uniform writeonly image2D nextOrigins;
layout(binding = kHierarchyNextDirectionsImage, rgba32f) uniform writeonly image2D nextDirections;
layout(binding = kHierarchyNextFromImage, r32ui) uniform writeonly uimage2D nextFrom;

uniform bool first, last;
uniform bool traced;  // the first rays come from the eye, and the sum is the picture
uniform float leastShare;
uniform bool flatShading;  // mirrors reflect at their shading normals all the same

#ifdef LIT
float sunShare(ivec2 pixel, SeenPoint seen) { return 1.0; }
#endif

// Share of a ray's light that the pixel's own surface reflects.
vec3 seenShare(ivec2 pixel) {
  if (traced) return vec3(1.0);
  const SurfaceMaterial seen = surfaceMaterials[surfaceMaterialOf[texelFetch(seenIds, pixel, 0).x]];
  return firstShare(seen, texelFetch(seenDirections, pixel, 0).w);
}

// True if what adds `share` to the sum is to be followed.
bool matters(vec3 share, ivec2 pixel) {
  const vec3 adds = share * seenShare(pixel);
  return max(adds.r, max(adds.g, adds.b)) > leastShare;
}

#ifdef POINTS
// A ray to the light from where the ray of this pixel ends; w of its origin: 0 if none is needed.
void shadowRay(ivec2 pixel, SurfacePoint point, out vec4 origin, out vec4 direction) {
  origin = direction = vec4(0.0);
  const vec3 toLight = lightPosition - point.position;
  if (dot(toLight, point.flatNormal) > 0.0) {
    origin = vec4(point.position, 1.0);
    direction = vec4(toLight, 0.0);
  } else {
    hits[pixel.y * sizePx.x + pixel.x].distance = 0u;
  }
}
#else
// The direction in which light is followed on; `share`: multiplied by what the surface passes on.
vec3 onwards(SurfacePoint point, inout vec3 share) {
  const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[point.triangle]];
#ifdef REFRACT
  if (material.transmittance != vec3(0.0)) {
    bool passes;
    const vec3 direction = refracted(point, material, passes);
    if (passes) share *= material.transmittance;
    return direction;
  }
#endif
  share *= mirrorShare(material.mirror, material.fresnel != 0u, dot(point.view, point.normal));
  return mirrored(point.view, point.normal, point.flatNormal);
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 origin = texelFetch(origins, pixel, 0);
  vec4 next = vec4(0.0), nextDirection = vec4(0.0);
  uint leaves = kHierarchyNoTriangle;
#ifndef POINTS
  vec3 sum = vec3(0.0), share = vec3(1.0);
  if (!first) {
    sum = imageLoad(sums, pixel).rgb;
    share = imageLoad(shares, pixel).rgb;
  }
#endif
  if (origin.w > 0.0) {
    const vec3 direction = texelFetch(directions, pixel, 0).xyz;
    const NearestHit hit = hits[pixel.y * sizePx.x + pixel.x];
    if (hit.triangle != kHierarchyNoTriangle) {
      const vec3 found = meeting(origin.xyz, direction, hit.triangle);
      SurfacePoint point = surfaceHit(hit.triangle, vec3(1.0 - found.y - found.z, found.yz), direction);
      leaves = hit.triangle;
#ifdef POINTS
      shadowRay(pixel, point, next, nextDirection);
#else
      if (!first || matters(share, pixel)) {
        SurfacePoint shaded = point;
        if (flatShading) shaded.normal = point.flatNormal;
        sum += share * pointColour(shaded, hit.distance == 0u ? 0.0 : 1.0);
        const vec3 way = onwards(point, share);
        if (!last && matters(share, pixel)) {
          next = vec4(point.position, 1.0);
          nextDirection = vec4(way, 0.0);
        }
      }
#endif
    } else {
#ifndef POINTS
      if (!first || matters(share, pixel)) sum += share * background;
#endif
    }
  }
#ifndef POINTS
  const bool cutShort = hits[sizePx.x * sizePx.y].distance != 0u;
  imageStore(sums, pixel, vec4(sum, cutShort ? uintBitsToFloat(0x7fc00000u) : 1.0));
  imageStore(shares, pixel, vec4(share, 1.0));
  if (last) return;
#endif
  imageStore(nextOrigins, pixel, next);
  imageStore(nextDirections, pixel, nextDirection);
  imageStore(nextFrom, pixel, uvec4(leaves));
}
