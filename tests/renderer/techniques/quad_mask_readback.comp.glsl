// SPDX-License-Identifier: BSD-3-Clause
// Writes the mask that each of many quads sets, or its convex hull, for comparison with brute force.
#include "tests/renderer/techniques/readback_bindings.h"
#include "renderer/techniques/soft_shadows/bitmask/occlusion_mask.glsl"
#include "renderer/techniques/soft_shadows/bitmask/quad_mask.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = kQuadMaskReadbackQuadsBuffer) readonly buffer Quads { vec4 corners[]; };  // two for each quad
layout(std430, binding = kQuadMaskReadbackResultsBuffer) writeonly buffer Results { int results[]; };
uniform int count;

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= uint(count)) return;
  const vec4 first = corners[2u * i], second = corners[2u * i + 1u];
#ifdef HULL
  ivec2 hull[4];
  const bool found = convexHull(toSteps(first.xy, 16), toSteps(first.zw, 16), toSteps(second.xy, 16),
                                toSteps(second.zw, 16), hull);
  results[9u * i] = int(found);
  for (int k = 0; k < 4; ++k) {
    results[9u * i + 1u + 2u * uint(k)] = hull[k].x;
    results[9u * i + 2u + 2u * uint(k)] = hull[k].y;
  }
#else
  clearMask();
  addQuadToMask(first.xy, first.zw, second.xy, second.zw);
  for (int k = 0; k < MASK_WORDS; ++k) results[i * uint(MASK_WORDS) + uint(k)] = int(mask[k]);
#endif
}
