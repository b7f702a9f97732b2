// SPDX-License-Identifier: BSD-3-Clause
// Mean colour of rays through a pixel's square, one at a random place in each cell of a grid.
#include "renderer/techniques/antialiasing/antialiasing_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSampleOutImage, rgba32f) uniform image2D outImage;

uniform ivec2 sizePx;
uniform int side;   // cells along each axis
uniform int first;  // row of cells of this pass
uniform uint seed;
uniform vec3 eyePosition;  // relative to the anchor
#include "renderer/techniques/antialiasing/surface_colour.glsl"
#include "renderer/ray_tracing/random_place.glsl"
#include "renderer/ray_tracing/trace.glsl"

bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) { return true; }

vec3 rayColour(vec2 place) {
  const vec3 direction = normalize(mat3(cameraToAnchor) * placeRay(place, rayScale, sizePx));
  const RayHit hit = rayClosestHit(Ray(eyePosition, direction, 0.0, kRayFarthest, kRayNoTriangle));
  if (hit.triangle == kRayNoTriangle) return background;
  const SurfacePoint point = surfaceHit(hit.triangle, vec3(1.0 - hit.u - hit.v, hit.u, hit.v), direction);
  SeenPoint seen;
  seen.position = (anchorToCamera * vec4(point.position, 1.0)).xyz;
  seen.normal = mat3(anchorToCamera) * point.flatNormal;
  seen.depth = -seen.position.z;
  return surfaceColour(point, seen);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  vec3 sum = first == 0 ? vec3(0.0) : imageLoad(outImage, pixel).rgb;
  vec3 row = vec3(0.0);
  for (int x = 0; x < side; ++x) {
    const uvec3 key = uvec3(uint(pixel.y * sizePx.x + pixel.x), uint(first * side + x), seed);
    row += rayColour(vec2(pixel) + (vec2(x, first) + randomPlace(key)) / float(side));
  }
  sum += row;
  if (first == side - 1) sum /= float(side) * float(side);
  imageStore(outImage, pixel, rayCutShort ? vec4(uintBitsToFloat(0x7fc00000u)) : vec4(sum, 1.0));
}
