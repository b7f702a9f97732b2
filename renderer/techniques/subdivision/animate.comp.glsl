// SPDX-License-Identifier: BSD-3-Clause
// The control mesh in its pose, where its own normals are asked for; otherwise the first step skins what it reads.
#include "renderer/techniques/subdivision/subdivision_bindings.h"

layout(local_size_x = kSubdivisionGroup) in;
layout(std430, binding = kCagePositionsBuffer) writeonly buffer Positions { vec4 positions[]; };
uniform uint vertexCount;

#include "renderer/techniques/subdivision/skinned.glsl"

void main() {
  const uint v = gl_GlobalInvocationID.x;
  if (v < vertexCount) positions[v] = vec4(skinned(v), 1.0);
}
