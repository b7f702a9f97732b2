// SPDX-License-Identifier: BSD-3-Clause
// A receiver's rays against all objects by their fields, and the count of look-ups. Set up by FieldReader::bind().
#include "renderer/visibility_fields/field_lookup.glsl"

#include "renderer/techniques/visibility_fields/field_counts.glsl"
uniform float slack;  // diameters

bool canBlock(FieldReceiver receiver, uint object) {
  const FieldObject of = fieldObjects[object];
  if (selfOcclusion == 0 && of.owner == receiver.object) return false;
  // No ray of the receiver's half space meets a sphere behind it.
  return dot(of.centre - receiver.origin, receiver.normal) > -of.radius;
}

// Distance to the nearest object; kFieldNothing: none.
float nearestDistance(FieldReceiver receiver, vec3 direction) {
  float nearest = kFieldNothing;
  for (uint object = 0u; object < fieldObjectCount; ++object) {
    if (!canBlock(receiver, object)) continue;
    const float distance = fieldDistance(object, receiver.origin, direction, slack);
    if (distance >= 0.0 && (nearest < 0.0 || distance < nearest)) nearest = distance;
  }
  return nearest;
}
