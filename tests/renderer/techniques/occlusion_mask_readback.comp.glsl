// SPDX-License-Identifier: BSD-3-Clause
// Writes the mask that each of many rectangles sets, for comparison with brute force.
#include "tests/renderer/techniques/readback_bindings.h"
#include "renderer/techniques/soft_shadows/bitmask/occlusion_mask.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = kMaskReadbackRectanglesBuffer) readonly buffer Rectangles { vec4 rectangles[]; };
layout(std430, binding = kMaskReadbackMasksBuffer) writeonly buffer Masks { uint masks[]; };
uniform int count;

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= uint(count)) return;
  clearMask();
  addToMask(rectangles[i].xy, rectangles[i].zw);
  for (int k = 0; k < MASK_WORDS; ++k) masks[i * uint(MASK_WORDS) + uint(k)] = mask[k];
}
