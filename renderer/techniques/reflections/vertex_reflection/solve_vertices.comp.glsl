// SPDX-License-Identifier: BSD-3-Clause
// Reflection points of all vertices of the reflected mesh (Roger 2008, section 2.2.3, "vertex buffer").
#include "renderer/techniques/reflections/vertex_reflection/secant.glsl"

layout(local_size_x = kVertexGroup) in;
layout(std430, binding = kReflectedPositionsBuffer) readonly buffer Positions { float positions[]; };
layout(std430, binding = kReflectedVerticesBuffer) buffer Reflected { vec4 reflected[]; };
uniform uint firstVertex, endVertex;

void main() {
  const uint i = firstVertex + gl_WorkGroupID.y * (65535u * uint(kVertexGroup)) + gl_GlobalInvocationID.x;
  if (i >= endVertex) return;
  const vec3 position = vec3(positions[3u * i], positions[3u * i + 1u], positions[3u * i + 2u]);
  vec4 previous = vec4(0.0);
#if GUESS == GUESS_PREVIOUS_FRAME
  previous = reflected[i];
#endif
  reflected[i] = reflectedVertex(position, previous);
}
