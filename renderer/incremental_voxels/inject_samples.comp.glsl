// SPDX-License-Identifier: BSD-3-Clause
// Fills the voxels that samples lie in, and adds the attributes of samples to the sums of their voxels, as whole numbers, so that
// their order does not matter. A sample an invocation, a view a layer of groups. Sums are in a hash table: which place of it is a
// voxel's depends on the order of execution; what comes of it does not.
#include "renderer/frame/frame_bindings.h"
#include "renderer/incremental_voxels/sampled_volume.glsl"
#include "renderer/incremental_voxels/seen_samples.glsl"
#ifdef ATTRIBUTES
#include "renderer/incremental_voxels/seen_surface.glsl"
#endif

layout(local_size_x = kSampleGroup) in;

shared uint addedCount, sampleCount, touchedCount;

#ifdef ATTRIBUTES
layout(std430, binding = kSampleSumsBuffer) buffer Sums { uint sampleSums[]; };
uniform float sampleScale, lightScale;  // units in 1
uniform uint placeMask;                 // places of the table, a power of 2, less 1

// A voxel's place, which it takes if it has none. There are at least twice as many as there are samples; the search ends in any case.
uint placeOf(ivec3 stored) {
  const uint key = kSampleKey | uint(stored.x) | uint(stored.y) << 10 | uint(stored.z) << 20;
  uint place = key * 2654435761u;  // golden ratio of 2^32 (Knuth 1998, section 6.4)
  place = (place ^ place >> 15) & placeMask;
  for (uint tried = 0u; tried < placeMask; ++tried) {
    uint found = sampleKeys[place];
    if (found == 0u) {
      found = atomicCompSwap(sampleKeys[place], 0u, key);
      if (found == 0u) atomicAdd(touchedCount, 1u);
    }
    if (found == 0u || found == key) return place;
    place = (place + 1u) & placeMask;
  }
  return place;
}

void addTo(uint first, vec3 value) {
  const ivec3 whole = ivec3(round(value));
  atomicAdd(sampleSums[first], uint(whole.x));
  atomicAdd(sampleSums[first + 1u], uint(whole.y));
  atomicAdd(sampleSums[first + 2u], uint(whole.z));
}
#endif

void main() {
  if (gl_LocalInvocationIndex == 0u) addedCount = sampleCount = touchedCount = 0u;
  barrier();
  const int view = int(gl_WorkGroupID.z);
  SeenSample seen;
  if (sampleOf(view, int(gl_GlobalInvocationID.x), seen)) {
    atomicAdd(sampleCount, 1u);
    const ivec3 at = storedVoxel(seen.voxel), texel = ivec3(at.x >> 5, at.yz);
    const uint bit = 1u << (at.x & 31);
    if ((imageLoad(bitsImage, texel).x & bit) == 0u && (imageAtomicOr(bitsImage, texel, bit) & bit) == 0u) atomicAdd(addedCount, 1u);
#ifdef ATTRIBUTES
    const uint first = (kSampleWords + kSampleViewWords * uint(USED_VIEWS)) * placeOf(at);
    const SeenSurface surface = surfaceOf(view, seen.pixel, seen.place);
    atomicAdd(sampleSums[first], 1u);
    addTo(first + 1u, sampleScale * surface.normal);
    addTo(first + 4u, sampleScale * surface.albedo);
    const uint own = first + kSampleWords + kSampleViewWords * uint(view);
    atomicAdd(sampleSums[own], 1u);
    addTo(own + 1u, lightScale * surface.light);
#endif
  }
  barrier();
  if (gl_LocalInvocationIndex == 0u && sampleCount > 0u) {
    atomicAdd(sampleCounts[turn].samples, sampleCount);
    if (addedCount > 0u) atomicAdd(sampleCounts[turn].added, addedCount);
    if (touchedCount > 0u) atomicAdd(sampleCounts[turn].touched, touchedCount);
  }
}
