// SPDX-License-Identifier: BSD-3-Clause
// A layer a slice from a bit a slice.
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSlicesBitsUnit) uniform usampler2D bits;
#ifdef SUMS
layout(binding = kSlicesCoveredImage, r32ui) uniform writeonly uimage2DArray outCovered;
#else
layout(binding = kSlicesCoveredImage, r16f) uniform writeonly image2DArray outCovered;
#endif
uniform int resolution, slices;

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (max(at.x, at.y) >= resolution) return;
  const uint covered = texelFetch(bits, at, 0).x;
  for (int slice = 0; slice < slices; ++slice) {
    const uint bit = (covered >> uint(slice)) & 1u;
#ifdef SUMS
    imageStore(outCovered, ivec3(at, slice), uvec4(bit));
#else
    imageStore(outCovered, ivec3(at, slice), vec4(float(bit)));
#endif
  }
}
