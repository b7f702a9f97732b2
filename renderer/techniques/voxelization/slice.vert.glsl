// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/voxels/volume.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in uint firstTriangle;
layout(location = 0) out vec3 place;  // in voxels
layout(location = 1) flat out uint first;

void main() {
  place = toVoxels(position);
  first = firstTriangle;
}
