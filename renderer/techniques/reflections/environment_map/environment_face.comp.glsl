// SPDX-License-Identifier: BSD-3-Clause
// One face of the map: the light of what is seen from its middle, and in alpha its distance; 0: nothing.
#include "renderer/techniques/reflections/reflection_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kEnvironmentIdsUnit) uniform usampler2D triangleIds;
layout(binding = kReflectionImage, rgba32f) uniform writeonly image2DArray faces;

uniform ivec2 sizePx;
uniform int face;
uniform vec3 centre;  // relative to the anchor
uniform bool flatShading;
#include "renderer/frame/shading.glsl"
#include "renderer/techniques/reflections/environment_map/cube_faces.glsl"

#ifdef LIT
float sunShare(ivec2 pixel, SeenPoint seen) { return 1.0; }
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(triangleIds, pixel, 0).x;
  vec4 found = vec4(background, 0.0);
  if (id != 0xffffffffu) {
    const vec3 direction = normalize(cubeDirection(face, vec2(pixel) + 0.5, sizePx.x));
    const uvec3 vertices = sceneTriangle(id);
    const vec3 a = scenePosition(vertices.x) - centre, b = scenePosition(vertices.y) - centre,
               c = scenePosition(vertices.z) - centre;
    const vec3 e1 = b - a, e2 = c - a, reach = max(abs(e1), abs(e2));
    const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
    const vec3 normal = cross(e1 * unit, e2 * unit);
    const vec3 at = dot(normal, a) / dot(normal, direction) * direction;
    SurfacePoint point = surfaceHit(id, barycentrics(a, b, c, at), direction);
    if (flatShading) point.normal = point.flatNormal;
    found = vec4(pointColour(point, 1.0), length(point.position - centre));
  }
  imageStore(faces, ivec3(pixel, face), found);
}
