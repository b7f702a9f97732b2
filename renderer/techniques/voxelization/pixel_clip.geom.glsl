// SPDX-License-Identifier: BSD-3-Clause
// A triangle, whole, to each slice that it reaches (Gaitatzes 2012, algorithm 6), as long as CAP vertices last.
#include "renderer/techniques/voxelization/slice_target.glsl"

layout(triangle_strip, max_vertices = CAP) out;
layout(location = 0) out float depth;
layout(location = 1) flat out vec2 range;

void main() {
  if (!facesAxis(cross(place[1] - place[0], place[2] - place[0]))) return;
  const float low = min(place[0][AXIS], min(place[1][AXIS], place[2][AXIS]));
  const float high = max(place[0][AXIS], max(place[1][AXIS], place[2][AXIS]));
  const int size = gridSize()[AXIS];
  if (!(high >= -kVoxelSlack && low <= float(size) + kVoxelSlack)) return;
  const int first = clamp(int(floor(low)), 0, size - 1), last = clamp(int(floor(high)), 0, size - 1);
  const int most = min(last, first + CAP / 3 - 1);
  for (int slice = first; slice <= most; ++slice) {
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
