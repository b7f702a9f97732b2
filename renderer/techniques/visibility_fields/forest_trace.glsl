// SPDX-License-Identifier: BSD-3-Clause
// As object_trace.glsl, of objects that move: each has a tree in its own axes and radii, so that where it stands does not matter. Rays are traced
// against the objects whose spheres they pass. Set up by FieldReader::bind() and bindTrees().
#include "renderer/ray_tracing/trace.glsl"
#include "renderer/visibility_fields/field_objects.glsl"

bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) { return true; }

// Distance at which a ray enters an object's sphere, a little larger for rounding, or 0 within it; kRayFarthest: not at all.
float sphereEntry(FieldReceiver receiver, uint index, vec3 direction) {
  const FieldObject object = fieldObjects[index];
  if (object.root == kRayNoRoot || selfOcclusion == 0 && object.owner == receiver.object) return kRayFarthest;
  const vec3 toCentre = object.centre - receiver.origin;
  const float along = dot(toCentre, direction), radius = 1.001 * object.radius;
  const vec3 beside = toCentre - along * direction;
  const float squared = radius * radius - dot(beside, beside);
  if (squared < 0.0 || along + radius < 0.0) return kRayFarthest;
  return max(along - sqrt(squared), 0.0);
}

// t in radii.
Ray rayOf(FieldObject object, FieldReceiver receiver, vec3 direction, float reach) {
  return Ray(fieldToObject(object, receiver.origin - object.centre) / object.radius, fieldToObject(object, direction), 0.0,
             reach / object.radius, receiver.triangle);
}

// Whether an object lies on the way, up to the distance `reach`.
bool isBlocked(FieldReceiver receiver, vec3 direction, float reach) {
  for (uint i = 0u; i < fieldObjectCount; ++i) {
    ++rayIterations;
    if (sphereEntry(receiver, i, direction) > reach) continue;
    rayRoot = fieldObjects[i].root;
    if (rayAnyHit(rayOf(fieldObjects[i], receiver, direction, reach))) return true;
  }
  return false;
}

// Distance to the nearest object; negative: none. The one whose sphere is entered first comes first, so that most others are skipped.
float tracedDistance(FieldReceiver receiver, vec3 direction) {
  uint first = fieldObjectCount;
  float least = kRayFarthest;
  for (uint i = 0u; i < fieldObjectCount; ++i) {
    ++rayIterations;
    const float entry = sphereEntry(receiver, i, direction);
    if (entry < least) {
      least = entry;
      first = i;
    }
  }
  if (first == fieldObjectCount) return -1.0;
  float nearest = kRayFarthest;
  for (uint turn = 0u; turn <= fieldObjectCount; ++turn) {
    ++rayIterations;
    const uint i = turn == 0u ? first : turn - 1u;
    if (turn > 0u && (i == first || !(sphereEntry(receiver, i, direction) < nearest))) continue;
    rayRoot = fieldObjects[i].root;
    const RayHit hit = rayClosestHit(rayOf(fieldObjects[i], receiver, direction, nearest));
    if (hit.triangle != kRayNoTriangle) nearest = hit.t * fieldObjects[i].radius;
  }
  return nearest < kRayFarthest ? nearest : -1.0;
}
