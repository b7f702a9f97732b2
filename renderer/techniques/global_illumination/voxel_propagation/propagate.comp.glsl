// SPDX-License-Identifier: BSD-3-Clause
// A step of all voxels.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kPropagateGroup, local_size_y = kPropagateGroup, local_size_z = kPropagateGroup) in;
#ifdef STOPS
layout(std430, binding = kPropagateChangesBuffer) buffer Changes { uint changes[]; };  // bits of floats, a step each
uniform int step_;
uniform float stopBelow;
#endif
#include "renderer/techniques/global_illumination/voxel_propagation/light_step.glsl"

Wall wallBeside(ivec3 voxel, int channel, int face) { return fetchWall(voxel + ivec3(faceDirection(face)), channel); }

void main() {
  const ivec3 at = ivec3(gl_GlobalInvocationID);  // z: channel and layer
  if (any(greaterThanEqual(at, ivec3(gridSize().xy, 3 * gridSizeZ)))) return;
#ifdef STOPS
  if (step_ > 0 && uintBitsToFloat(changes[step_ - 1]) <= stopBelow) return;
#endif
  const int channel = at.z / gridSizeZ, read = (3 * from + channel) * gridSizeZ, write = 3 * to * gridSizeZ;
  const ivec3 voxel = ivec3(at.xy, at.z - channel * gridSizeZ), last = gridSize() - 1;
  const uint cell = texelFetch(lightCells, voxel, 0).x;
  const vec4 own = texelFetch(fields, ivec3(voxel.xy, read + voxel.z), 0), lit = texelFetch(source, at, 0);
  vec4 beside[6];
  for (int face = 0; face < 6; ++face) {
    const ivec3 there = clamp(voxel + ivec3(faceDirection(face)), ivec3(0), last);
    beside[face] = texelFetch(fields, ivec3(there.xy, read + there.z), 0);
  }
  const vec4 sum = afterStep(voxel, channel, cell, own, beside, lit);
  imageStore(next, ivec3(at.xy, write + at.z), sum);
#ifdef STOPS
  if (holdsLight(cell)) atomicMax(changes[step_], floatBitsToUint(abs(sum.x - own.x)));
#endif
}
