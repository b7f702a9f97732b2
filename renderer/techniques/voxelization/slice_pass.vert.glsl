// SPDX-License-Identifier: BSD-3-Clause
// Everything, seen along AXIS between the planes of one slice. The first and the last slice hold what rounding puts outside.
#include "renderer/techniques/voxelization/seen_along.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in uint firstTriangle;
layout(location = 2) out vec3 point;
layout(location = 3) flat out uint first;
uniform int slice;

void main() {
  const int size = gridSize()[AXIS];
  const float low = slice == 0 ? -kVoxelSlack : float(slice);
  const float high = slice == size - 1 ? float(size) + kVoxelSlack : float(slice + 1);
  point = toVoxels(position);
  first = firstTriangle;
  gl_Position = vec4(onLayer(point).xy, (point[AXIS] - low) / (high - low), 1.0);
}
