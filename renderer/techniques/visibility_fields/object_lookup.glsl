// SPDX-License-Identifier: BSD-3-Clause
// A receiver's rays against all objects by their fields, and the count of look-ups. Set up by FieldReader::bind(). Including shaders define
// seenAt().
#include "renderer/visibility_fields/field_seen.glsl"

#include "renderer/techniques/visibility_fields/field_counts.glsl"
uniform float slackSpacings;

bool canBlock(FieldReceiver receiver, uint object) {
  const FieldObject of = fieldObjects[object];
  if (selfOcclusion == 0 && of.owner == receiver.object) return false;
  // No ray of the receiver's half space meets a sphere behind it.
  return dot(of.centre - receiver.origin, receiver.normal) > -of.radius;
}

// In diameters. Only an object's own surface must be told from what blocks its rays.
float slackOf(FieldReceiver receiver, FieldObject object) {
  if (receiver.object != object.owner) return 0.0;
  fieldUse(object);
  return 0.5 * slackSpacings * (FIELD_POSITION_SPACING + FIELD_TEXEL_SPACING);
}

// Share of a ray that an object lets through.
float seenPast(FieldReceiver receiver, uint index, vec3 direction) {
  const FieldObject object = fieldObjects[index];
#if FIELD_FETCH == 0
  const float distance = fieldHit(object, receiver.origin, direction, slackOf(receiver, object)).distance;
  return distance < 0.0 ? 1.0 : seenAt(distance);
#else
  return fieldSeen(fieldView(object, receiver.origin, slackOf(receiver, object)), fieldToObject(object, direction));
#endif
}

// Past all: what the one lets through that lets through least; fieldRange so, too.
float seenPastAll(FieldReceiver receiver, vec3 direction) {
  float least = 1.0;
#ifdef FIELD_DOUBT
  vec2 range = vec2(1.0);
#endif
  for (uint object = 0u; object < fieldObjectCount; ++object) {
    if (!canBlock(receiver, object)) continue;
    least = min(least, seenPast(receiver, object, direction));
#ifdef FIELD_DOUBT
    range = min(range, fieldRange);
    if (range.y <= 0.0) break;  // whatever others let through
#endif
  }
#ifdef FIELD_DOUBT
  fieldRange = range;
#endif
  return least;
}
