// SPDX-License-Identifier: BSD-3-Clause
// Vertices of parts that move, where they are at a time. See moved_vertices.h.
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = kMoveGroup) in;
layout(std430, binding = kMoveRestPositionsBuffer) readonly buffer RestPositions { float restPositions[]; };
layout(std430, binding = kMoveMotionOfBuffer) readonly buffer MotionOf { uint motionOf[]; };  // 0: rests
layout(std430, binding = kMovePositionsBuffer) writeonly buffer Positions { float positions[]; };
#ifdef NORMALS
layout(std430, binding = kMoveRestNormalsBuffer) readonly buffer RestNormals { float restNormals[]; };
layout(std430, binding = kMoveNormalsBuffer) writeonly buffer Normals { float normals[]; };
#endif

uniform mat4 motions[kMostMotions];  // relative to the anchor
uniform uint vertexCount;

void main() {
  const uint vertex = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(kMoveGroup) +
                      gl_LocalInvocationIndex;
  if (vertex >= vertexCount) return;
  const uint motion = motionOf[vertex], first = 3u * vertex;
  // What rests keeps its place to the last bit, and has it already.
  if (motion == 0u) return;
  const mat4 moves = motions[motion - 1u];
  const vec3 place =
      (moves * vec4(restPositions[first], restPositions[first + 1u], restPositions[first + 2u], 1.0)).xyz;
  for (uint i = 0u; i < 3u; ++i) positions[first + i] = place[i];
#ifdef NORMALS
  const vec3 normal = mat3(moves) * vec3(restNormals[first], restNormals[first + 1u], restNormals[first + 2u]);
  for (uint i = 0u; i < 3u; ++i) normals[first + i] = normal[i];
#endif
}
