// SPDX-License-Identifier: BSD-3-Clause
// A step: each voxel gathers the flux that its six neighbours send through its far faces, as lobes about the axes, and all steps are
// summed. Nothing blocks light but, if asked for, the surfaces in a voxel. Source: Kaplanyan and Dachsbacher 2010, section 4.
#include "renderer/techniques/global_illumination/voxel_propagation/transport.glsl"
#include "renderer/voxels/volume.glsl"

layout(local_size_x = kPropagateGroup, local_size_y = kPropagateGroup, local_size_z = kPropagateGroup) in;
layout(binding = kPropagateFieldUnit) uniform sampler2DArray field;
layout(binding = kPropagateOutImage, FIELD_FORMAT) uniform writeonly image2DArray next;
layout(binding = kPropagateSumImage, FIELD_FORMAT) uniform image2DArray sum;
uniform bool first;  // the field is what has been put in

void main() {
  const ivec3 at = ivec3(gl_GlobalInvocationID);  // z: channel and layer
  if (any(greaterThanEqual(at, ivec3(gridSize().xy, 3 * gridSizeZ)))) return;
  const int channel = at.z / gridSizeZ;
  const ivec3 voxel = ivec3(at.xy, at.z - channel * gridSizeZ);
  vec4 light = vec4(0.0);
  for (int face = 0; face < 6; ++face) {
    const ivec3 from = voxel - ivec3(faceDirection(face));
    if (!isInGrid(from)) continue;
    float passing = 1.0;
#if BLOCKERS != BLOCKERS_NONE
    if (isOccupied(from)) {
      const vec4 surface = texelFetch(volumeNormal, from, 0);
      const float along = dot(surface.xyz, faceDirection(face));
#if BLOCKERS == BLOCKERS_FRONTS
      // A surface blocks what comes towards its front, not what it sends itself, which starts in its own voxel.
      passing -= surface.w * clamp(-along, 0.0, 1.0);
#else
      passing -= surface.w * min(abs(along), 1.0);
#endif
    }
#endif
    light += passing * towards(texelFetch(field, from + ivec3(0, 0, channel * gridSizeZ), 0), face) / 12.5663706;
  }
  imageStore(next, at, light);
  imageStore(sum, at, light + (first ? texelFetch(field, at, 0) : imageLoad(sum, at)));
}
