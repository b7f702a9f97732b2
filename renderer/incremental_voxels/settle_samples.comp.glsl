// SPDX-License-Identifier: BSD-3-Clause
// Attributes of touched voxels from their sums, which are emptied, as is the table that these are in: a place an invocation.
// Light is what the camera's samples show, which holds that of all lights; where there are none, the sum over the lights of what
// their samples show (Gaitatzes 2012, section 7.5).
#include "renderer/incremental_voxels/sampled_volume.glsl"

layout(local_size_x = kSampleGroup) in;
layout(std430, binding = kSampleSumsBuffer) buffer Sums { uint sampleSums[]; };
uniform uint placeMask;
uniform float sampleScale, lightScale;

vec3 signedSum(uint first) {
  return vec3(int(sampleSums[first]), int(sampleSums[first + 1u]), int(sampleSums[first + 2u]));
}

void main() {
  const uint place = uint(kSampleGroup) * (gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y) + gl_LocalInvocationIndex;
  if (place > placeMask) return;
  const uint key = sampleKeys[place];
  if (key == 0u) return;
  sampleKeys[place] = 0u;
  const uint words = kSampleWords + kSampleViewWords * uint(USED_VIEWS), first = words * place;
  const ivec3 stored = ivec3(key & 1023u, key >> 10 & 1023u, key >> 20 & 1023u);
  const float each = 1.0 / float(sampleSums[first]);
  vec3 light = vec3(0.0);
  for (uint view = 0u; view < uint(USED_VIEWS); ++view) {
    const uint own = first + kSampleWords + kSampleViewWords * view, count = sampleSums[own];
    if (count > 0u) light += signedSum(own + 1u) / (lightScale * float(count));
    if (view == 0u && count > 0u) break;
  }
  storeAttributes(stored, each / sampleScale * signedSum(first + 1u), each / sampleScale * signedSum(first + 4u), light);
  for (uint i = 0u; i < words; ++i) sampleSums[first + i] = 0u;
}
