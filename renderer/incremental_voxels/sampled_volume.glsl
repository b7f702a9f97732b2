// SPDX-License-Identifier: BSD-3-Clause
// A volume that is filled from samples, as SampledVolume::bind() binds it.
#include "renderer/incremental_voxels/incremental_bindings.h"

layout(binding = kSampledBitsImage, r32ui) uniform uimage2DArray bitsImage;
layout(std430, binding = kSampleStateBuffer) buffer State {
  SampleCounts sampleCounts[2];
  uint sampleKeys[];
};
uniform int turn;  // which of the counts are this step's

#ifdef ATTRIBUTES
layout(binding = kSampledNormalImage, rgba16f) uniform writeonly image2DArray normalImage;
layout(binding = kSampledAlbedoImage, rgba16f) uniform writeonly image2DArray albedoImage;
layout(binding = kSampledLightImage, rgba16f) uniform writeonly image2DArray lightImage;

// `stored`: where the voxel is stored.
void storeAttributes(ivec3 stored, vec3 normal, vec3 albedo, vec3 light) {
  imageStore(normalImage, stored, vec4(normal, 1.0));
  imageStore(albedoImage, stored, vec4(albedo, 1.0));
  imageStore(lightImage, stored, vec4(light, 1.0));
}

void eraseAttributes(ivec3 stored) {
  imageStore(normalImage, stored, vec4(0.0));
  imageStore(albedoImage, stored, vec4(0.0));
  imageStore(lightImage, stored, vec4(0.0));
}
#else
void eraseAttributes(ivec3 stored) {}
#endif
