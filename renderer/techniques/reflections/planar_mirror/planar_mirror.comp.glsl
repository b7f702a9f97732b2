// SPDX-License-Identifier: BSD-3-Clause
// One bounce of every pixel: START finds the plane of the mirror that it sees; otherwise the colour of what the mirrored
// view shows there is added, and the ray goes on to the plane of the mirror that this is. See planar_mirror.cpp.
#include "renderer/techniques/reflections/reflection_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kReflectionOriginsUnit) uniform sampler2D origins;
layout(binding = kReflectionDirectionsUnit) uniform sampler2D directions;
layout(binding = kReflectionIdsUnit) uniform usampler2D triangleIds;  // START: of the camera; otherwise of the mirrored view
layout(std430, binding = kViewGroupsBuffer) readonly buffer Groups { uint planeOf[]; };
layout(binding = kReflectionImage, rgba32f) uniform image2D outImage;  // light so far; alpha 0: this ray found no plane
layout(binding = kPlanarOriginImage, rgba32f) uniform image2D rayOrigin;
layout(binding = kPlanarDirectionImage, rgba32f) uniform image2D rayDirection;
layout(binding = kPlanarShareImage, rgba32f) uniform image2D rayShare;
layout(binding = kPlanarChainImage, r32ui) uniform uimage2D chains;

uniform ivec2 sizePx;
uniform uint planeCount;
uniform bool flatShading, followed;
#include "renderer/frame/mirrored.glsl"
#include "renderer/frame/shading.glsl"

#ifdef LIT
float sunShare(ivec2 pixel, SeenPoint seen) { return 1.0; }
#endif

// Of a triangle's plane, scaled so that squares of tiny areas stay within float's range.
vec3 scaledNormal(vec3 a, vec3 b, vec3 c) {
  const vec3 e1 = b - a, e2 = c - a, reach = max(abs(e1), abs(e2));
  const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
  return cross(e1 * unit, e2 * unit);
}

// The number of a chain: its planes as digits, 0 if it has ended.
void go(ivec2 pixel, uint chain, SurfacePoint point, vec3 direction, vec3 share) {
  imageStore(chains, pixel, uvec4(chain));
  imageStore(rayOrigin, pixel, vec4(point.position, 0.0));
  imageStore(rayDirection, pixel, vec4(direction, 0.0));
  imageStore(rayShare, pixel, vec4(share, 0.0));
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(triangleIds, pixel, 0).x;
#ifdef START
  const vec4 origin = texelFetch(origins, pixel, 0);
  SurfacePoint point;
  point.position = origin.xyz;
  const uint plane = origin.w > 0.0 && id != 0xffffffffu ? planeOf[id] : 0xffffffffu;
  imageStore(outImage, pixel, vec4(vec3(0.0), plane == 0xffffffffu ? 0.0 : 1.0));
  go(pixel, plane == 0xffffffffu ? 0u : plane + 1u, point, texelFetch(directions, pixel, 0).xyz, vec3(1.0));
#else
  const uint chain = imageLoad(chains, pixel).x;
  if (chain == 0u) return;
  const vec3 origin = imageLoad(rayOrigin, pixel).xyz, direction = imageLoad(rayDirection, pixel).xyz;
  const vec3 share = imageLoad(rayShare, pixel).rgb;
  const vec3 sum = imageLoad(outImage, pixel).rgb;
  SurfacePoint none;
  none.position = vec3(0.0);
  if (id == 0xffffffffu) {
    imageStore(outImage, pixel, vec4(sum + share * background, 1.0));
    go(pixel, 0u, none, vec3(0.0), vec3(0.0));
    return;
  }
  const uvec3 vertices = sceneTriangle(id);
  const vec3 a = scenePosition(vertices.x) - origin, b = scenePosition(vertices.y) - origin,
             c = scenePosition(vertices.z) - origin;
  const vec3 normal = scaledNormal(a, b, c);
  const float t = dot(normal, a) / dot(normal, direction);
  SurfacePoint point = surfaceHit(id, barycentrics(a, b, c, t * direction), direction);
  const vec3 mirrorNormal = point.normal;
  if (flatShading) point.normal = point.flatNormal;
  const vec3 total = sum + share * pointColour(point, 1.0);
  imageStore(outImage, pixel, vec4(total, 1.0));
  const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[id]];
  const uint plane = planeOf[id];
  if (!followed || material.mirror == vec3(0.0) || plane == 0xffffffffu) {
    // A mirror in none of the planes shows the background.
    if (followed && material.mirror != vec3(0.0))
      imageStore(outImage, pixel,
                 vec4(total + share * mirrorShare(material.mirror, material.fresnel != 0u, dot(point.view, mirrorNormal)) *
                                  background, 1.0));
    go(pixel, 0u, none, vec3(0.0), vec3(0.0));
    return;
  }
  go(pixel, chain * planeCount + plane + 1u, point, mirrored(point.view, mirrorNormal, point.flatNormal),
     share * mirrorShare(material.mirror, material.fresnel != 0u, dot(point.view, mirrorNormal)));
#endif
}
