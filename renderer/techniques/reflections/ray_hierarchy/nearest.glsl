// SPDX-License-Identifier: BSD-3-Clause
// Ray and triangle of a pair: see meet.glsl.
#include "renderer/techniques/reflections/ray_hierarchy/meet.glsl"

layout(std430, binding = kHierarchyHitsBuffer) buffer Hits { NearestHit hits[]; };

// True if the ray of `pixel` meets the triangle.
bool meet(ivec2 pixel, uint triangle) {
  const vec4 origin = texelFetch(origins, pixel, 0);
  if (!(origin.w > 0.0) || texelFetch(from, pixel, 0).x == triangle) return false;
  const uint slot = uint(pixel.y * sizePx.x + pixel.x);
  const vec4 direction = texelFetch(directions, pixel, 0);
#ifdef SHADOW
  if (hits[slot].distance == 0u) return false;
  const float t = meeting(origin.xyz, direction.xyz, triangle).x;
  if (!(t > 0.0 && t <= 1.0)) return false;
  hits[slot].distance = 0u;
#else
  const float t = meeting(origin.xyz, direction.xyz, triangle).x;
  if (!(t > 0.0)) return false;
  if (atomicMin(hits[slot].distance, floatBitsToUint(t)) < floatBitsToUint(t)) return true;
  uint held = hits[slot].triangle;
  for (int tries = 0; tries < 1024; ++tries) {
    if (held != kHierarchyNoTriangle) {
      const float other = meeting(origin.xyz, direction.xyz, held).x;
      if (other < t || (other == t && held <= triangle)) break;
    }
    const uint found = atomicCompSwap(hits[slot].triangle, held, triangle);
    if (found == held) break;
    held = found;
  }
#endif
  return true;
}
