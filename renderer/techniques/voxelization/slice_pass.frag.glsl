// SPDX-License-Identifier: BSD-3-Clause
#define TRIANGLE_FROM_DRAW
#include "renderer/techniques/voxelization/slice_output.glsl"

// What lies in the plane between two slices is in the one behind it; clipping leaves it in both.
void main() {
  if (gl_FragCoord.z >= 1.0) discard;
  writeFragment();
}
