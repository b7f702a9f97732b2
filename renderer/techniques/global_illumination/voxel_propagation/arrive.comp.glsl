// SPDX-License-Identifier: BSD-3-Clause
// What the field sends to each face of each occupied voxel: irradiance of the three channels; alpha: 1 where the voxel beyond the
// face is empty.
#include "renderer/techniques/global_illumination/voxel_propagation/light_bounds.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/transport.glsl"

layout(local_size_x = kPropagateGroup, local_size_y = kPropagateGroup, local_size_z = kPropagateGroup) in;
layout(binding = kPropagateFieldUnit) uniform sampler2DArray field;
layout(binding = kArriveFacesImage, ARRIVED_FORMAT) uniform ARRIVED_ACCESS image2DArray arrived;  // layer: face * depth + z
uniform bool first;

void main() {
  const ivec3 voxel = ivec3(gl_GlobalInvocationID);
  if (!isInGrid(voxel) || !isOccupied(voxel)) return;
  for (int face = 0; face < 6; ++face) {
    const ivec3 beyond = voxel + ivec3(faceDirection(face)), to = voxel + ivec3(0, 0, face * gridSizeZ);
    vec4 light = vec4(0.0);
    if (isOpen(beyond)) {
      light.a = 1.0;
      for (int channel = 0; channel < 3; ++channel)
        light[channel] = max(leaving(texelFetch(field, beyond + ivec3(0, 0, channel * gridSizeZ), 0), face ^ 1).x, 0.0);
#ifdef SUMMED
      if (!first) light.rgb += imageLoad(arrived, to).rgb;
#endif
    }
    imageStore(arrived, to, light);
  }
}
