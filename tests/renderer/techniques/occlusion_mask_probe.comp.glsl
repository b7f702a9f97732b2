// SPDX-License-Identifier: BSD-3-Clause
// Writes the mask that each of many rectangles sets, for comparison with brute force.
#include "renderer/techniques/soft_shadows/bitmask/occlusion_mask.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Rectangles { vec4 rectangles[]; };
layout(std430, binding = 1) writeonly buffer Masks { uint masks[]; };
uniform int count;

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= uint(count)) return;
  clearMask();
  addToMask(rectangles[i].xy, rectangles[i].zw);
  for (int k = 0; k < MASK_WORDS; ++k) masks[i * uint(MASK_WORDS) + uint(k)] = mask[k];
}
