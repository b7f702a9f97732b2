// SPDX-License-Identifier: BSD-3-Clause
// Share of rays over the hemisphere of each pixel's point, by the cosine, that hit nothing within the radius.
#include "renderer/techniques/ambient_occlusion/occlusion_bindings.h"
#include "renderer/ray_tracing/random_place.glsl"
#include "renderer/ray_tracing/trace.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kOcclusionPositionUnit) uniform sampler2D positions;
layout(binding = kOcclusionNormalUnit) uniform sampler2D normals;
layout(binding = kOcclusionIdsUnit) uniform usampler2D triangleIds;
layout(binding = kOcclusionOutImage, rgba32f) uniform image2D outImage;
uniform ivec2 sizePx;
uniform int side, row;  // cells of directions along each axis; this pass's
uniform uint seed;
uniform float radius;
uniform vec3 eyePosition;  // relative to the anchor

bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) { return true; }

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(triangleIds, pixel, 0).x;
  if (id == 0xffffffffu) {
    imageStore(outImage, pixel, vec4(1.0));
    return;
  }
  const vec3 normal = texelFetch(normals, pixel, 0).xyz;
  // Clear of neighbours in the same plane.
  const vec3 seen = texelFetch(positions, pixel, 0).xyz;
  const vec3 origin = seen + 1e-5 * distance(seen, eyePosition) * normal;
  const vec3 helper = abs(normal.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  const vec3 tangent = normalize(cross(helper, normal)), other = cross(normal, tangent);
  float open = row == 0 ? 0.0 : imageLoad(outImage, pixel).x;
  for (int x = 0; x < side; ++x) {
    const vec2 u =
        (vec2(x, row) + randomPlace(uvec3(uint(pixel.y * sizePx.x + pixel.x), uint(row * side + x), seed))) / float(side);
    const float r = sqrt(u.x), phi = 6.28318531 * u.y;
    const vec3 direction = r * cos(phi) * tangent + r * sin(phi) * other + sqrt(max(0.0, 1.0 - u.x)) * normal;
    if (!rayAnyHit(Ray(origin, direction, 0.0, radius, id))) open += 1.0;
  }
  if (row == side - 1) open /= float(side) * float(side);
  imageStore(outImage, pixel, rayCutShort ? vec4(uintBitsToFloat(0x7fc00000u)) : vec4(vec3(open), 1.0));
}
