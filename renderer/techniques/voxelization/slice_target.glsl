// SPDX-License-Identifier: BSD-3-Clause
// Where a geometry shader sends a point of a triangle that it assigns to AXIS.
#include "renderer/techniques/voxelization/seen_along.glsl"

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

bool facesAxis(vec3 normal) { return longestAxis(normal) == AXIS; }
