// SPDX-License-Identifier: BSD-3-Clause
// Counts what lod_difference.glsl finds in the object's rectangle: sums in shared memory, then one addition of
// integers a group, so that the order does not matter. MARK: shows where they are instead, for looking at.
#include "renderer/techniques/perceptual_lod/perceptual_lod_bindings.h"
#include "renderer/techniques/perceptual_lod/lod_difference.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
#ifdef MARK
layout(binding = kLevelTestVisibleImage, r32f) uniform writeonly image2D visibleMap;

void main() {
  const ivec2 pixel = tests[test].low + ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(pixel, tests[test].high)) && look(pixel).visible) imageStore(visibleMap, pixel, vec4(1.0));
}
#else
layout(std430, binding = kLevelTestCountsBuffer) buffer Counts { uint counts[]; };  // covered, visible, next visible; a test each

shared uint sums[3];

void main() {
  if (gl_LocalInvocationIndex < 3u) sums[gl_LocalInvocationIndex] = 0u;
  barrier();
  const ivec2 pixel = tests[test].low + ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(pixel, tests[test].high))) {
    const Seen seen = look(pixel);
    if (seen.covered) atomicAdd(sums[0], 1u);
    if (seen.visible) atomicAdd(sums[1], 1u);
    if (seen.nextVisible) atomicAdd(sums[2], 1u);
  }
  barrier();
  if (gl_LocalInvocationIndex < 3u && sums[gl_LocalInvocationIndex] > 0u)
    atomicAdd(counts[4 * test + int(gl_LocalInvocationIndex)], sums[gl_LocalInvocationIndex]);
}
#endif
