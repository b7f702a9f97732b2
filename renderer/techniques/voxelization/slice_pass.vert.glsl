// SPDX-License-Identifier: BSD-3-Clause
// Everything, seen along AXIS between the planes of one slice. The first and the last slice hold what rounding puts outside.
#include "renderer/voxels/volume.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in uint firstTriangle;
layout(location = 2) out vec3 point;
layout(location = 3) flat out uint first;
uniform int slice;

vec2 across(vec3 v) { return AXIS == 0 ? v.yz : AXIS == 1 ? v.zx : v.xy; }

void main() {
  const int size = gridSize()[AXIS];
  const float low = slice == 0 ? -kVoxelSlack : float(slice);
  const float high = slice == size - 1 ? float(size) + kVoxelSlack : float(slice + 1);
  point = toVoxels(position);
  first = firstTriangle;
  // Row 0 of images is their top.
  gl_Position = vec4(vec2(2.0, -2.0) * across(point) / across(vec3(gridSize())) + vec2(-1.0, 1.0),
                     (point[AXIS] - low) / (high - low), 1.0);
}
