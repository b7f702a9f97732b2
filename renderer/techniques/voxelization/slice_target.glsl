// SPDX-License-Identifier: BSD-3-Clause
// Where a geometry shader sends a point of a triangle that it assigns to AXIS.
#include "renderer/voxels/volume.glsl"

layout(triangles) in;
layout(location = 0) in vec3 place[];
layout(location = 1) flat in uint firstTriangle[];
#if defined(SUMS) && !defined(CONSERVATIVE)
layout(location = 2) out vec3 point;  // in voxels
#endif
#if defined(SUMS) || defined(CONSERVATIVE)
layout(location = 3) flat out uint triangle;
#endif

// What a fragment's attributes are made from.
void carry(vec3 at) {
#if defined(SUMS) && !defined(CONSERVATIVE)
  point = at;
  triangle = firstTriangle[0] + uint(gl_PrimitiveIDIn);
#endif
}

vec2 across(vec3 v) { return AXIS == 0 ? v.yz : AXIS == 1 ? v.zx : v.xy; }

// Of axes with equal components the first.
bool facesAxis(vec3 normal) {
  const vec3 size = abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return axis == AXIS;
}

// Row 0 of images is their top.
vec4 onLayerAcross(vec2 at) { return vec4(vec2(2.0, -2.0) * at / across(vec3(gridSize())) + vec2(-1.0, 1.0), 0.5, 1.0); }
vec4 onLayer(vec3 v) { return onLayerAcross(across(v)); }
