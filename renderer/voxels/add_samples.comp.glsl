// SPDX-License-Identifier: BSD-3-Clause
// Adds the attributes of samples to the sums of their voxels, as whole numbers, so that their order does not matter.
#include "renderer/voxels/seen_samples.glsl"
#include "renderer/voxels/seen_surface.glsl"

layout(local_size_x = kSampleGroup) in;
layout(binding = kSlotsImage, r32ui) uniform readonly uimage2DArray slotsImage;
layout(std430, binding = kSampleSumsBuffer) buffer Sums { uint sampleSums[]; };
uniform float sampleScale, lightScale;  // units in 1

void addTo(uint first, vec3 value) {
  const ivec3 whole = ivec3(round(value));
  atomicAdd(sampleSums[first], uint(whole.x));
  atomicAdd(sampleSums[first + 1u], uint(whole.y));
  atomicAdd(sampleSums[first + 2u], uint(whole.z));
}

void main() {
  const int view = int(gl_WorkGroupID.z);
  SeenSample seen;
  if (!sampleOf(view, int(gl_GlobalInvocationID.x), seen)) return;
  const SeenSurface surface = surfaceOf(view, seen.pixel, seen.place);
  const uint first = (kSampleWords + kSampleViewWords * uint(USED_VIEWS)) * imageLoad(slotsImage, storedVoxel(seen.voxel)).x;
  atomicAdd(sampleSums[first], 1u);
  addTo(first + 1u, sampleScale * surface.normal);
  addTo(first + 4u, sampleScale * surface.albedo);
  const uint own = first + kSampleWords + kSampleViewWords * uint(view);
  atomicAdd(sampleSums[own], 1u);
  addTo(own + 1u, lightScale * surface.light);
}
