// SPDX-License-Identifier: BSD-3-Clause
// A receiver's rays against the triangles of all objects: isBlocked() and tracedDistance(). In one tree, set up by ObjectTracer::bind() or
// FieldReader::bindTrees(); with RAY_FOREST in one for each object (forest_trace.glsl).
#include "renderer/ray_tracing/trace.glsl"

#ifdef RAY_FOREST
#include "renderer/techniques/visibility_fields/forest_trace.glsl"
#else
uint receiverObject = kFieldNoObject;

bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) {
  return selfOcclusion != 0 || objectOf[hit.triangle] != receiverObject;
}

// Whether an object lies on the way, up to the distance `reach`.
bool isBlocked(FieldReceiver receiver, vec3 direction, float reach) {
  ++rayIterations;
  receiverObject = receiver.object;
  return rayAnyHit(Ray(receiver.origin, direction, 0.0, reach, receiver.triangle));
}

// Distance to the nearest object; negative: none.
float tracedDistance(FieldReceiver receiver, vec3 direction) {
  ++rayIterations;
  receiverObject = receiver.object;
  const RayHit hit = rayClosestHit(Ray(receiver.origin, direction, 0.0, kRayFarthest, receiver.triangle));
  return hit.triangle == kRayNoTriangle ? -1.0 : hit.t;
}
#endif
