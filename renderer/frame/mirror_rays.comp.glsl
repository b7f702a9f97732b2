// SPDX-License-Identifier: BSD-3-Clause
// The rays that leave the mirrors which pixels see. See mirror_rays.h.
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kMirrorRaysIdsUnit) uniform usampler2D triangleIds;
layout(binding = kMirrorRaysOriginsImage, rgba32f) uniform writeonly image2D origins;
layout(binding = kMirrorRaysDirectionsImage, rgba32f) uniform writeonly image2D directions;
#ifdef SHOWN
layout(std430, binding = kMirrorRaysShownBuffer) readonly buffer Shown { uint shownTriangles[]; };  // a bit each
#endif

uniform ivec2 sizePx;
#include "renderer/frame/mirrored.glsl"
#include "renderer/frame/ray_origin.glsl"
#include "renderer/frame/refracted.glsl"
#include "renderer/frame/surface_point.glsl"

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(triangleIds, pixel, 0).x;
  vec4 origin = vec4(0.0), direction = vec4(0.0);
  bool hasRay = id != 0xffffffffu && surfaceMaterials[surfaceMaterialOf[id]].mirror != vec3(0.0);
#ifdef REFRACT
  const bool refracts =
      id != 0xffffffffu && surfaceMaterials[surfaceMaterialOf[id]].transmittance != vec3(0.0);
  hasRay = hasRay || refracts;
#endif
#ifdef SHOWN
  hasRay = hasRay && (shownTriangles[id / 32u] >> (id % 32u) & 1u) != 0u;
#endif
  if (hasRay) {
    SeenPoint seen;
    const SurfacePoint point = surfaceSeen(pixel, id, seen);
    const uvec3 vertices = sceneTriangle(id);
    origin = vec4(pointOnTriangle(scenePosition(vertices.x), scenePosition(vertices.y),
                                  scenePosition(vertices.z), point.position),
                  1.0);
    direction = vec4(mirrored(point.view, point.normal, point.flatNormal),
                     clamp(dot(point.view, point.normal), 0.0, 1.0));
#ifdef REFRACT
    if (refracts) {
      bool passes;
      direction.xyz = refracted(point, surfaceMaterials[surfaceMaterialOf[id]], passes);
      if (!passes) direction.w = kTotalReflectionCosine;
    }
#endif
  }
  imageStore(origins, pixel, origin);
  imageStore(directions, pixel, direction);
}
