// SPDX-License-Identifier: BSD-3-Clause
// What shaders of visibility fields are bound to. For C++ and GLSL. Storage buffers 0, 1, 6 and 7 are left to
// the scene and to the tree of its rays.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::visibility_fields {
#endif

const uint kFieldObjectsBuffer = 2u;  // FieldObject each
const uint kFieldMapsBuffer =
    3u;  // vec4 a map: position on the unit sphere; mean distance of hits, share of the diameter
const uint kFieldObjectOfBuffer = 4u;  // of each triangle of the scene, uint; kFieldNoObject: none
const uint kFieldSumsBuffer =
    5u;  // of each word of an object while its field is made: vec2 sum and number of hits
const uint kFieldCornersBuffer = 2u;  // while a field with normals is made: vec4 a corner of each triangle
const uint kFieldCutShortBuffer =
    4u;  // while a field is made: number of words that a software renderer's limit cut short
const uint kFieldWordsUnit = 8u;  // usampler2DArray
const uint kFieldWordsImage = 0u;
const int kFieldMakeGroup = 64;
const uint kFieldBatchRaysBuffer = 0u;       // of given rays: BatchRay each (ray_tracing_bindings.h)
const uint kFieldBatchDistancesBuffer = 1u;  // float each
const int kFieldBatchGroup = 64;
const uint kFieldNoObject = 0xffffffffu;

struct FieldObject {  // std430
  vec3 centre;        // relative to the scene's anchor
  float radius;
  // Of the object in the world, unit. In w, of fields of several forms: segments + 256 side + 2^17 bits; the first slice of
  // its words; positions.
  vec4 axisX, axisY, axisZ;
  uint firstMap;             // of its field
  uint owner;                // number of the rigid object that it is, or a part of
  uint albedo;               // packUnorm4x8
  uint root;                 // of its tree in the fields' RayForest; kRayNoRoot: none
};
#ifdef __cplusplus
static_assert(sizeof(FieldObject) == 80 && offsetof(FieldObject, axisX) == 16);
#endif

#ifdef __cplusplus
}  // namespace limen::visibility_fields
#endif
