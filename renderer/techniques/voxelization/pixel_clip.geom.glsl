// SPDX-License-Identifier: BSD-3-Clause
// A triangle, whole, to each slice that it reaches (Gaitatzes 2012, algorithm 6), as long as CAP vertices last.
#include "renderer/techniques/voxelization/slice_target.glsl"

layout(triangle_strip, max_vertices = CAP) out;
layout(location = 0) out float depth;
layout(location = 1) flat out vec2 range;

void main() {
  const ivec2 slices = slicesReached(0.0);
  const int size = gridSize()[AXIS], most = min(slices.y, slices.x + CAP / 3 - 1);
  for (int slice = slices.x; slice <= most; ++slice) {
    for (int i = 0; i < 3; ++i) {
      gl_Position = onLayer(place[i]);
      gl_Layer = slice;
      depth = place[i][AXIS];
      carry(place[i]);
      range = vec2(slice == 0 ? -kVoxelSlack : float(slice), slice == size - 1 ? float(size) + kVoxelSlack : float(slice + 1));
      EmitVertex();
    }
    EndPrimitive();
  }
}
