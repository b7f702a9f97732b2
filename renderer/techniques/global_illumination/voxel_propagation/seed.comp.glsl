// SPDX-License-Identifier: BSD-3-Clause
// The injected light as the field's source.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kPropagateGroup, local_size_y = kPropagateGroup, local_size_z = kPropagateGroup) in;
layout(binding = kInjectSumsImage, r32ui) uniform readonly uimage2DArray sums;
layout(binding = kPropagateOutImage, FIELD_FORMAT) uniform writeonly image2DArray source;
#ifdef FIELD_TOO
layout(binding = kSeedFieldImage, FIELD_FORMAT) uniform writeonly image2DArray field;
uniform bool restart;  // the field is the source
#endif
uniform int sumSets;  // volumes of sums, one after another, that are added
#include "renderer/voxels/volume.glsl"

void main() {
  const ivec3 at = ivec3(gl_GlobalInvocationID);  // z: channel and layer
  if (any(greaterThanEqual(at, ivec3(gridSize().xy, 3 * gridSizeZ)))) return;
  const int channel = at.z / gridSizeZ, z = at.z - channel * gridSizeZ;
  vec4 light = vec4(0.0);
  for (int set_ = 0; set_ < sumSets; ++set_) {
    const ivec3 first = ivec3(at.xy, (12 * set_ + 4 * channel) * gridSizeZ + z), next = ivec3(0, 0, gridSizeZ);
    light += vec4(ivec4(imageLoad(sums, first).x, imageLoad(sums, first + next).x, imageLoad(sums, first + 2 * next).x,
                        imageLoad(sums, first + 3 * next).x));
  }
  imageStore(source, at, light / kInjectFixed);
#ifdef FIELD_TOO
  if (restart) imageStore(field, at, light / kInjectFixed);
#endif
}
