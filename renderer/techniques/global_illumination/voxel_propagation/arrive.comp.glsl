// SPDX-License-Identifier: BSD-3-Clause
// What the field sends to each face of each occupied voxel: irradiance of the three channels; alpha: 1 where the voxel beyond the
// face is empty. All others: 0.
#include "renderer/techniques/global_illumination/voxel_propagation/light_cells.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/transport.glsl"
#include "renderer/voxels/volume.glsl"

layout(local_size_x = kPropagateGroup, local_size_y = kPropagateGroup, local_size_z = kPropagateGroup) in;
layout(binding = kPropagateFieldUnit) uniform sampler2DArray fields;  // see propagate.comp.glsl
layout(binding = kArriveFacesImage, ARRIVED_FORMAT) uniform ARRIVED_ACCESS image2DArray arrived;  // layer: face * depth + z
uniform int from;
uniform bool first;
#ifdef RESIDENT
layout(std430, binding = kStepStuckBuffer) readonly buffer Stuck { uint stuck; };  // see propagate_resident.comp.glsl
#endif

void main() {
  const ivec3 to = ivec3(gl_GlobalInvocationID);  // z: face and layer
  if (any(greaterThanEqual(to, ivec3(gridSize().xy, 6 * gridSizeZ)))) return;
  const int face = to.z / gridSizeZ;
  const ivec3 voxel = ivec3(to.xy, to.z - face * gridSizeZ);
  const uint cell = texelFetch(lightCells, voxel, 0).x;
  vec4 light = vec4(0.0);
  if (holdsSurface(cell) && besideLight(cell, face) && !besideSurface(cell, face)) {
    const ivec3 beyond = voxel + ivec3(faceDirection(face));
    light.a = 1.0;
    for (int channel = 0; channel < 3; ++channel) {
      const int layer = (3 * from + channel) * gridSizeZ + beyond.z;
      light[channel] = max(leaving(texelFetch(fields, ivec3(beyond.xy, layer), 0), face ^ 1).x, 0.0);
    }
#ifdef RESIDENT
    if (stuck != 0u) light.rgb = vec3(uintBitsToFloat(0x7fc00000u));
#endif
#ifdef SUMMED
    if (!first) light.rgb += imageLoad(arrived, to).rgb;
#endif
  }
  imageStore(arrived, to, light);
}
