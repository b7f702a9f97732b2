// SPDX-License-Identifier: BSD-3-Clause
// Only what lies within the slice; a slice holds its near plane, the last one both.
#include "renderer/techniques/voxelization/slice_output.glsl"

layout(location = 0) in float depth;
layout(location = 1) flat in vec2 range;

void main() {
  if (!(depth >= range.x && depth < range.y)) discard;
  writeFragment();
}
