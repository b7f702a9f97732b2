// SPDX-License-Identifier: BSD-3-Clause
// The nearest object along a ray, with the normal, by fields that store normals.
#include "renderer/visibility_fields/field_lookup.glsl"

layout(std430, binding = kFieldObjectOfBuffer) readonly buffer ObjectOf { uint objectOf[]; };
uniform float slackSpacings;

struct ObjectHit {
  float distance;  // kFieldNothing: none
  vec3 normal;     // towards where the ray comes from
  uint albedo;     // packUnorm4x8
};

// `only`: number of the object that is looked up, kFieldNoObject: all; `without`: one that is not; `own`: the one on whose surface the ray
// starts, which alone must be told from what blocks it.
ObjectHit nearestObject(vec3 origin, vec3 direction, uint only, uint without, uint own) {
  ObjectHit nearest = ObjectHit(kFieldNothing, -direction, 0u);
  const float slack = 0.5 * slackSpacings * (FIELD_POSITION_SPACING + FIELD_TEXEL_SPACING);  // diameters
  for (uint object = 0u; object < fieldObjectCount; ++object) {
    const FieldObject of = fieldObjects[object];
    if (of.owner == without || (only != kFieldNoObject && of.owner != only)) continue;
    const FieldHit hit = fieldHit(of, origin, direction, of.owner == own ? slack : 0.0);
    if (hit.distance < 0.0 || (nearest.distance >= 0.0 && hit.distance >= nearest.distance)) continue;
    nearest = ObjectHit(hit.distance, fieldNormalAt(of, hit), of.albedo);
  }
  return nearest;
}
