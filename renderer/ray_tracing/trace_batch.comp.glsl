// SPDX-License-Identifier: BSD-3-Clause
// Rays given in a buffer: the closest hit of each, or (ANY) any.
#include "renderer/ray_tracing/trace.glsl"

layout(local_size_x = kRayBatchGroup) in;
layout(std430, binding = kRayBatchRaysBuffer) readonly buffer Rays { BatchRay rays[]; };
layout(std430, binding = kRayBatchHitsBuffer) writeonly buffer Hits { BatchHit hits[]; };

uniform uint firstRay, rayCount;  // up to rayCount

bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) { return true; }

void main() {
  const uint index = firstRay + gl_GlobalInvocationID.x;
  if (index >= rayCount) return;
  const BatchRay given = rays[index];
  const Ray ray = Ray(given.origin, given.direction, given.near, given.far, kRayNoTriangle);
#ifdef ANY
  const RayHit hit = rayTraverse(ray, true);
#else
  const RayHit hit = rayClosestHit(ray);
#endif
  hits[index] = BatchHit(rayCutShort ? uintBitsToFloat(0x7fc00000u) : hit.t, hit.triangle, hit.u, hit.v);
}
