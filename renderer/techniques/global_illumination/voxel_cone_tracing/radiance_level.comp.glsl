// SPDX-License-Identifier: BSD-3-Clause
// A level of one face's pyramid from the finer one: along the face's axis, the front of two voxels covers the other; the four columns
// are averaged.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kPropagateGroup, local_size_y = kPropagateGroup, local_size_z = kPropagateGroup) in;
layout(binding = kRadianceUnit) uniform sampler3D finer;
layout(binding = kRadianceFacesImage, rgba16f) uniform writeonly image3D coarser;
uniform int level, face;  // level: the finer one

vec4 over(vec4 front, vec4 back) { return front + (1.0 - front.a) * back; }

void main() {
  const ivec3 voxel = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(voxel, imageSize(coarser)))) return;
  const int axis = face >> 1;
  const ivec3 along = ivec3(axis == 0, axis == 1, axis == 2), u = along.zxy, v = along.yzx;
  const bool highFront = (face & 1) == 0;
  vec4 sum = vec4(0.0);
  for (int column = 0; column < 4; ++column) {
    const ivec3 low = 2 * voxel + (column & 1) * u + (column >> 1) * v;
    const vec4 a = texelFetch(finer, low, level), b = texelFetch(finer, low + along, level);
    sum += 0.25 * (highFront ? over(b, a) : over(a, b));
  }
  imageStore(coarser, voxel, sum);
}
