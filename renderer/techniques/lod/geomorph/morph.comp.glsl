// SPDX-License-Identifier: BSD-3-Clause
// Moves the vertices of each level towards their targets by the level's share.
#include "renderer/techniques/lod/lod_bindings.h"

layout(local_size_x = kMorphGroup) in;
layout(std430, binding = kMorphPositionsBuffer) readonly buffer Positions { float positions[]; };
layout(std430, binding = kMorphTargetsBuffer) readonly buffer Targets { float targets[]; };
layout(std430, binding = kMorphGroupsBuffer) readonly buffer Groups { uint groupOf[]; };  // of each vertex
layout(std430, binding = kMorphSharesBuffer) readonly buffer Shares { float shares[]; };  // of each group
layout(std430, binding = kMorphMovedBuffer) writeonly buffer Moved { float moved[]; };
uniform uint vertexCount;

void main() {
  const uint vertex = gl_GlobalInvocationID.y * (1u << 20) + gl_GlobalInvocationID.x;
  if (gl_GlobalInvocationID.x >= (1u << 20) || vertex >= vertexCount) return;
  const float share = shares[groupOf[vertex]];
  for (uint i = 3u * vertex; i < 3u * vertex + 3u; ++i) moved[i] = mix(positions[i], targets[i], share);
}
