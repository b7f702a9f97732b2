// SPDX-License-Identifier: BSD-3-Clause
// Where the number of bounces is limited: what surfaces reflect of a field whose steps they absorb, which is the source of the field
// of one bounce more.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kPropagateGroup, local_size_y = kPropagateGroup, local_size_z = kPropagateGroup) in;
layout(binding = kReflectedImage, rgba32f) uniform image2DArray reflectedLight;
#include "renderer/techniques/global_illumination/voxel_propagation/light_step.glsl"

uniform bool adds;   // what this field reflects
uniform bool first;  // in place of what was there
uniform bool seeds;  // the next field starts with it

Wall wallBeside(ivec3 voxel, int channel, int face) { return fetchWall(voxel + ivec3(faceDirection(face)), channel); }

void main() {
  const ivec3 at = ivec3(gl_GlobalInvocationID);  // z: channel and layer
  if (any(greaterThanEqual(at, ivec3(gridSize().xy, 3 * gridSizeZ)))) return;
  const int channel = at.z / gridSizeZ;
  const ivec3 voxel = ivec3(at.xy, at.z - channel * gridSizeZ);
  const uint cell = texelFetch(lightCells, voxel, 0).x;
  vec4 sum = first ? vec4(0.0) : imageLoad(reflectedLight, at);
  if (adds && holdsLight(cell) && !holdsSurface(cell)) {
    const vec4 own = texelFetch(fields, ivec3(voxel.xy, (3 * from + channel) * gridSizeZ + voxel.z), 0);
    for (int face = 0; face < 6; ++face)
      if (besideSurface(cell, face)) sum += reflectedAt(voxel, channel, face, leaving(own, face));
  }
  imageStore(reflectedLight, at, sum);
  if (seeds) imageStore(next, ivec3(voxel.xy, (3 * to + channel) * gridSizeZ + voxel.z), lightKept(keptOf(sum)));
}
