// SPDX-License-Identifier: BSD-3-Clause
// Fills the voxels that samples lie in, and gives those with attributes a place for their sums. A sample an invocation, a view a
// layer of groups. Which place it is depends on the order of execution; what comes of it does not.
#include "renderer/voxels/seen_samples.glsl"

layout(local_size_x = kSampleGroup) in;
layout(binding = kSampledBitsImage, r32ui) uniform uimage2DArray bitsImage;
layout(std430, binding = kSampleStateBuffer) buffer State {
  SampleCounts sampleCounts[2];
  uint sampleList[];
};
uniform int turn;
#ifdef ATTRIBUTES
layout(binding = kTouchedBitsImage, r32ui) uniform uimage2DArray touchedImage;
layout(binding = kSlotsImage, r32ui) uniform writeonly uimage2DArray slotsImage;
#endif

shared uint addedCount, sampleCount;

void main() {
  if (gl_LocalInvocationIndex == 0u) addedCount = sampleCount = 0u;
  barrier();
  SeenSample seen;
  if (sampleOf(int(gl_WorkGroupID.z), int(gl_GlobalInvocationID.x), seen)) {
    atomicAdd(sampleCount, 1u);
    const ivec3 at = storedVoxel(seen.voxel), texel = ivec3(at.x >> 5, at.yz);
    const uint bit = 1u << (at.x & 31);
    if ((imageLoad(bitsImage, texel).x & bit) == 0u && (imageAtomicOr(bitsImage, texel, bit) & bit) == 0u) atomicAdd(addedCount, 1u);
#ifdef ATTRIBUTES
    if ((imageLoad(touchedImage, texel).x & bit) == 0u && (imageAtomicOr(touchedImage, texel, bit) & bit) == 0u) {
      const uint slot = atomicAdd(sampleCounts[turn].touched, 1u);
      sampleList[slot] = uint(at.x) | uint(at.y) << 10 | uint(at.z) << 20;
      imageStore(slotsImage, at, uvec4(slot));
    }
#endif
  }
  barrier();
  if (gl_LocalInvocationIndex == 0u && sampleCount > 0u) {
    atomicAdd(sampleCounts[turn].samples, sampleCount);
    if (addedCount > 0u) atomicAdd(sampleCounts[turn].added, addedCount);
  }
}
