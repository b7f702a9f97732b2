// SPDX-License-Identifier: BSD-3-Clause
// Everything, seen along AXIS. Nothing is clipped along it.
#include "renderer/techniques/voxelization/seen_along.glsl"

layout(location = 0) in vec3 position;
layout(location = 0) out float depth;  // in voxels

void main() {
  const vec3 place = toVoxels(position);
  depth = place[AXIS];
  gl_Position = onLayer(place);
}
