// SPDX-License-Identifier: BSD-3-Clause
// Everything, seen along AXIS. Nothing is clipped along it.
#include "renderer/voxels/volume.glsl"

layout(location = 0) in vec3 position;
layout(location = 0) out float depth;  // in voxels

vec2 across(vec3 v) { return AXIS == 0 ? v.yz : AXIS == 1 ? v.zx : v.xy; }

void main() {
  const vec3 place = toVoxels(position);
  depth = place[AXIS];
  // Row 0 of images is their top.
  gl_Position = vec4(vec2(2.0, -2.0) * across(place) / across(vec3(gridSize())) + vec2(-1.0, 1.0), 0.5, 1.0);
}
