// SPDX-License-Identifier: BSD-3-Clause
// The pyramid's finest level: light of the lamp and of surfaces themselves, and with BOUNCE what the voxels reflect of each other.
#include "renderer/techniques/global_illumination/voxel_cone_tracing/radiance.glsl"

layout(local_size_x = kPropagateGroup, local_size_y = kPropagateGroup, local_size_z = kPropagateGroup) in;
layout(std430, binding = kFaceSumsBuffer) readonly buffer Sums { uint faceSums[]; };
layout(binding = kRadianceFacesImage, rgba16f) uniform writeonly image3D faces[6];

void main() {
  const ivec3 voxel = ivec3(gl_GlobalInvocationID);
  if (!isInGrid(voxel)) return;
  const uint first = kFaceSums * uint(voxel.x + gridSizeX * (voxel.y + gridSizeY * voxel.z));
  const bool solid = isOccupied(voxel);
  const vec4 surface = texelFetch(volumeNormal, voxel, 0);
  vec4 light[6];
  for (int face = 0; face < 6; ++face) {
    const uint at = first + 4u * uint(face);
    const float weight = float(faceSums[at]);
    light[face] = vec4(0.0);
    if (weight > 0.0) light[face].rgb = vec3(faceSums[at + 1u], faceSums[at + 2u], faceSums[at + 3u]) / weight;
#ifdef BOUNCE
    if (solid && weight > 0.0) {
      const int axis = face >> 1;
      const vec3 normal = ((face & 1) == 0 ? 1.0 : -1.0) * vec3(axis == 0, axis == 1, axis == 2);
      light[face].rgb += texelFetch(volumeAlbedo, voxel, 0).rgb * conesAbout(vec3(voxel) + 0.5, normal);
    }
#endif
    // A slanted surface covers a column of voxels in two of them: half the coverage is enough.
    light[face].a = min(2.0 * weight / kInjectFixed, 1.0) * (solid ? surface.w : 1.0);
    light[face].rgb *= light[face].a;
  }
  imageStore(faces[0], voxel, light[0]);
  imageStore(faces[1], voxel, light[1]);
  imageStore(faces[2], voxel, light[2]);
  imageStore(faces[3], voxel, light[3]);
  imageStore(faces[4], voxel, light[4]);
  imageStore(faces[5], voxel, light[5]);
}
