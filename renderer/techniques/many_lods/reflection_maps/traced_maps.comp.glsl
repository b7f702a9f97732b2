// SPDX-License-Identifier: BSD-3-Clause
// Maps of objects by rays through the middles of their pixels: what triangles drawn into them would show. A row of groups a view.
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kGatherGroup) in;
uniform ivec2 sizePx;
#include "renderer/frame/mirror_trace.glsl"

// In textures, as the tree and the scene take all buffers.
layout(binding = kTracedMapViewsUnit) uniform sampler2D viewRows;  // eye, axes x, y and z of each view
layout(binding = kMapObjectsUnit) uniform usampler2D objectOf;
layout(binding = kTracedMapImage, rgba32f) uniform writeonly image2D maps;  // colour; depth, or -1

uniform int side;
uniform float inverseRange;

void main() {
  const int pixel = int(gl_GlobalInvocationID.x), number = int(gl_WorkGroupID.y);
  if (pixel >= side * side) return;
  const vec3 eye = texelFetch(viewRows, ivec2(0, number), 0).xyz, x = texelFetch(viewRows, ivec2(1, number), 0).xyz,
             y = texelFetch(viewRows, ivec2(2, number), 0).xyz, z = texelFetch(viewRows, ivec2(3, number), 0).xyz;
  const vec2 at = 2.0 * (vec2(pixel % side, pixel / side) + 0.5) / float(side) - 1.0;
  const float square = dot(at, at);
  const vec3 direction = normalize(2.0 * at.x * x + 2.0 * at.y * y + (1.0 - square) * z);
  vec4 held = vec4(0.0, 0.0, 0.0, -1.0);
  Ray ray = Ray(eye, direction, 0.0, kRayFarthest, kRayNoTriangle);
  // Out of the object itself.
  for (int i = 0; i < 16; ++i) {
    const RayHit hit = rayClosestHit(ray);
    if (hit.triangle == kRayNoTriangle) break;
    const int index = int(hit.triangle);
    if (texelFetch(objectOf, ivec2(index % kMapObjectsWidth, index / kMapObjectsWidth), 0).x == uint(number / 2 + 1)) {
      ray.near = hit.t;
      ray.skipped = hit.triangle;
      continue;
    }
    held = vec4(hitColour(hitPoint(ray, hit), false), min(hit.t * inverseRange, 0.99999988));
    break;
  }
  if (rayCutShort) held = vec4(uintBitsToFloat(0x7fc00000u));
  imageStore(maps, ivec2(pixel % side, pixel / side) + ivec2(number % kMapRow, number / kMapRow) * side, held);
}
