// SPDX-License-Identifier: BSD-3-Clause
// The rays that leave a pixel's mirror within the cone of its gloss, the same for fields and for tracers: one in each cell of
// a grid over the cone's solid angle. w = 1: a ray; 0: none, as it leads beneath the surface, or, of a perfect mirror, is
// the first ray again.
#include "renderer/ray_tracing/random_place.glsl"
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kLobeOriginsUnit) uniform sampler2D origins;
layout(binding = kLobeMirroredUnit) uniform sampler2D mirroredRays;
layout(binding = kLobeIdsUnit) uniform usampler2D triangleIds;
#ifdef FIELD_PRIMARY
layout(binding = kLobeNormalsUnit) uniform sampler2D foundNormals;  // w = 1: of a field
#endif
layout(binding = kLobeDirectionsImage, rgba32f) uniform writeonly image2DArray directions;
uniform ivec2 sizePx;
uniform int raySide, turned;
uniform uint seed;
#include "renderer/frame/surface_point.glsl"

vec3 inCone(vec3 axis, float halfAngle, vec2 u) {
  const float s = sin(0.5 * halfAngle), versine = 2.0 * s * s * u.x;
  const vec3 side = normalize(cross(axis, abs(axis.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
  const float angle = 6.28318531 * u.y, sine = sqrt(max(versine * (2.0 - versine), 0.0));
  return normalize((1.0 - versine) * axis + sine * (cos(angle) * side + sin(angle) * cross(axis, side)));
}

vec3 surfaceNormal(ivec2 pixel, uint id) {
#ifdef FIELD_PRIMARY
  const vec4 found = texelFetch(foundNormals, pixel, 0);
  if (found.w > 0.0) return found.xyz;
#endif
  SeenPoint seen;
  return surfaceSeen(pixel, id, seen).flatNormal;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const bool hasRay = texelFetch(origins, pixel, 0).w > 0.0;
  vec3 axis = vec3(0.0), normal = vec3(0.0);
  float gloss = 0.0;
  if (hasRay) {
    const uint id = texelFetch(triangleIds, pixel, 0).x;
    axis = texelFetch(mirroredRays, pixel, 0).xyz;
    gloss = surfaceMaterials[surfaceMaterialOf[id]].glossRad;
    if (gloss > 0.0) normal = surfaceNormal(pixel, id);
  }
  for (int i = 0; i < raySide * raySide; ++i) {
    vec4 ray = vec4(axis, hasRay && i == 0 ? 1.0 : 0.0);
    if (gloss > 0.0) {
      const vec2 within =
          turned == 0 ? vec2(0.5) : randomPlace(uvec3(uint(pixel.y * sizePx.x + pixel.x), uint(i), seed));
      ray.xyz = inCone(axis, gloss, (vec2(i % raySide, i / raySide) + within) / float(raySide));
      ray.w = dot(ray.xyz, normal) > 0.0 ? 1.0 : 0.0;
    }
    imageStore(directions, ivec3(pixel, i), ray);
  }
}
