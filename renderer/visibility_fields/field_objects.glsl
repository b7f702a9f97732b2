// SPDX-License-Identifier: BSD-3-Clause
// Where objects with fields are. Set up by VisibilityFields::bind().
#include "renderer/visibility_fields/field_bindings.h"

layout(std430, binding = kFieldObjectsBuffer) readonly buffer FieldObjects { FieldObject fieldObjects[]; };
uniform uint fieldObjectCount;

vec3 fieldToObject(FieldObject object, vec3 v) {
  return vec3(dot(object.axisX.xyz, v), dot(object.axisY.xyz, v), dot(object.axisZ.xyz, v));
}
