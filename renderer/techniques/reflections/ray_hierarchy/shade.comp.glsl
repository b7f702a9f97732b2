// SPDX-License-Identifier: BSD-3-Clause
// What the rays of one bounce bring, and the rays that leave the surfaces they met. See ray_hierarchy.cpp.
uniform ivec2 sizePx;
#include "renderer/frame/mirrored.glsl"
#include "renderer/frame/shading.glsl"
#include "renderer/techniques/reflections/ray_hierarchy/meet.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(std430, binding = kHierarchyHitsBuffer) readonly buffer Hits { NearestHit hits[]; };
layout(binding = kHierarchySumsImage, rgba32f) uniform image2D sums;
layout(binding = kHierarchySharesImage, rgba32f) uniform image2D shares;
layout(binding = kHierarchyNextOriginsImage, rgba32f) uniform writeonly image2D nextOrigins;
layout(binding = kHierarchyNextDirectionsImage, rgba32f) uniform writeonly image2D nextDirections;
layout(binding = kHierarchyNextFromImage, r32ui) uniform writeonly uimage2D nextFrom;

uniform bool first, last;
uniform float leastShare;
uniform vec3 lightAt;  // relative to the anchor

float sunShare(ivec2 pixel, SeenPoint seen) { return 1.0; }

#ifdef REFRACT
// Through the surface, or mirrored by it where nothing passes; `outside`: the normal of the triangle's front.
vec3 refracted(SurfacePoint point, SurfaceMaterial material, vec3 outside, out bool passes) {
  const float index = material.refractiveIndex, ratio = dot(outside, point.view) > 0.0 ? 1.0 / index : index;
  const vec3 through = refract(-point.view, point.normal, ratio);
  passes = dot(through, through) > 0.25;
  if (!passes) return mirrored(point.view, point.normal, point.flatNormal);
  if (dot(through, point.flatNormal) < 0.0) return normalize(through);
  return -point.view;
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 origin = texelFetch(origins, pixel, 0);
  const bool cutShort = hits[sizePx.x * sizePx.y].distance != 0u;
  vec3 sum = vec3(0.0), share = vec3(1.0);
  if (!first) {
    sum = imageLoad(sums, pixel).rgb;
    share = imageLoad(shares, pixel).rgb;
  }
  vec4 next = vec4(0.0), nextDirection = vec4(0.0);
  uint leaves = kHierarchyNoTriangle;
  if (origin.w > 0.0) {
    const vec3 direction = texelFetch(directions, pixel, 0).xyz;
    const NearestHit hit = hits[pixel.y * sizePx.x + pixel.x];
    if (hit.triangle == kHierarchyNoTriangle) {
#ifdef POINTS
      // no point, no light
#else
      sum += share * background;
#endif
    } else {
      const vec3 found = meeting(origin.xyz, direction, hit.triangle);
      const SurfacePoint point = surfaceHit(hit.triangle, vec3(1.0 - found.y - found.z, found.yz), direction);
#ifdef POINTS
      // From the light, as far as the point.
      const vec3 towards = point.position - lightAt;
      const float far = length(towards);
      if (far > 0.0 && dot(point.normal, -towards) > 0.0) {
        next = vec4(lightAt, 1.0);
        nextDirection = vec4(towards / far, far * (1.0 - kShadowMargin));
        leaves = hit.triangle;
      }
#else
      sum += share * pointColour(point, hit.distance == 0u ? 0.0 : 1.0);
      const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[hit.triangle]];
      vec3 onwards;
      vec3 part = mirrorShare(material.mirror, material.fresnel != 0u, dot(point.view, point.normal));
#ifdef REFRACT
      if (material.transmittance != vec3(0.0)) {
        const uvec3 vertices = sceneTriangle(hit.triangle);
        const vec3 corner = scenePosition(vertices.x);
        const vec3 e1 = scenePosition(vertices.y) - corner, e2 = scenePosition(vertices.z) - corner;
        bool passes;
        onwards = refracted(point, material, cross(e1, e2), passes);
        part = passes ? material.transmittance : vec3(1.0);
      } else
#endif
        onwards = mirrored(point.view, point.normal, point.flatNormal);
      share *= part;
      if (!last && max(share.r, max(share.g, share.b)) > leastShare) {
        next = vec4(point.position, 1.0);
        nextDirection = vec4(onwards, 0.0);
        leaves = hit.triangle;
      }
#endif
    }
  }
#ifndef POINTS
  imageStore(sums, pixel, vec4(sum, cutShort ? uintBitsToFloat(0x7fc00000u) : 1.0));
  imageStore(shares, pixel, vec4(share, 1.0));
  if (last) return;
#endif
  imageStore(nextOrigins, pixel, next);
  imageStore(nextDirections, pixel, nextDirection);
  imageStore(nextFrom, pixel, uvec4(leaves));
}
