// SPDX-License-Identifier: BSD-3-Clause
// One level of a pyramid of averages, of all layers, from the level below.
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kAverageBelowImage, TEXEL) uniform readonly image2DArray below;
layout(binding = kAverageAboveImage, TEXEL) uniform writeonly image2DArray above;
uniform int side, layers;

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (max(at.x, at.y) >= side) return;
  for (int layer = 0; layer < layers; ++layer) {
    vec4 total = vec4(0.0);
    for (int i = 0; i < 4; ++i) total += 0.25 * imageLoad(below, ivec3(2 * at + ivec2(i & 1, i >> 1), layer));
    imageStore(above, ivec3(at, layer), total);
  }
}
