// SPDX-License-Identifier: BSD-3-Clause
// A receiver's rays against the triangles of the objects that its field would be asked for, each in the object's own axes and radii:
// where an object stands does not matter. A work group shares the rays of a listed pixel. After field_receiver.glsl.
#define RAY_FOREST
#include "renderer/techniques/visibility_fields/object_lookup.glsl"
#include "renderer/ray_tracing/trace.glsl"

layout(std430, binding = kNearListBuffer) readonly buffer NearList {
  NearListHeader nearList;
  uint nearPixels[];
};

bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) { return true; }

// The pixel of this work group.
bool nearPixel(out ivec2 pixel) {
  const uint place = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  if (place >= nearList.listed) return false;
  const uint word = nearPixels[place];
  pixel = ivec2(word & 0xffffu, word >> 16);
  return true;
}

// In axes and radii of an object; t in radii.
Ray rayOf(FieldObject object, FieldReceiver receiver, vec3 direction, float reach) {
  return Ray(fieldToObject(object, receiver.origin - object.centre) / object.radius, fieldToObject(object, direction), 0.0,
             reach / object.radius, receiver.triangle);
}

// Whether a ray passes an object's sphere before `reach`; a little larger, for rounding.
bool nearMeetsSphere(FieldObject object, FieldReceiver receiver, vec3 direction, float reach) {
  const vec3 toCentre = object.centre - receiver.origin;
  const float along = dot(toCentre, direction), radius = 1.001 * object.radius;
  const vec3 beside = toCentre - along * direction;
  return dot(beside, beside) <= radius * radius && along + radius >= 0.0 && along - radius <= reach;
}

// Whether an object lies on the way, up to the distance `reach`.
bool nearIsBlocked(FieldReceiver receiver, vec3 direction, float reach) {
  for (uint i = 0u; i < fieldObjectCount; ++i) {
    ++rayIterations;
    rayRoot = fieldObjects[i].root;
    if (rayRoot == kRayNoRoot || !canBlock(receiver, i) || !nearMeetsSphere(fieldObjects[i], receiver, direction, reach)) continue;
    if (rayAnyHit(rayOf(fieldObjects[i], receiver, direction, reach))) return true;
  }
  return false;
}

// Distance to the nearest object; negative: none.
float nearDistance(FieldReceiver receiver, vec3 direction) {
  float nearest = -1.0;
  for (uint i = 0u; i < fieldObjectCount; ++i) {
    ++rayIterations;
    rayRoot = fieldObjects[i].root;
    const float reach = nearest < 0.0 ? kRayFarthest : nearest;
    if (rayRoot == kRayNoRoot || !canBlock(receiver, i) || !nearMeetsSphere(fieldObjects[i], receiver, direction, reach)) continue;
    const RayHit hit = rayClosestHit(rayOf(fieldObjects[i], receiver, direction, reach));
    if (hit.triangle != kRayNoTriangle) nearest = hit.t * fieldObjects[i].radius;
  }
  return nearest;
}

shared float nearSums[kNearGroup];
shared uint nearCutShort;
// Sum over the work group's invocations, all of which call it, in a fixed order: the same bytes in every run. NaN if a ray was cut short.
float nearSum(float value) {
  const int lane = int(gl_LocalInvocationIndex);
  if (lane == 0) nearCutShort = 0u;
  nearSums[lane] = value;
  barrier();
  if (rayCutShort) atomicOr(nearCutShort, 1u);
  for (int width = kNearGroup / 2; width > 0; width /= 2) {
    if (lane < width) nearSums[lane] += nearSums[lane + width];
    barrier();
  }
  return nearCutShort != 0u ? uintBitsToFloat(0x7fc00000u) : nearSums[0];
}
