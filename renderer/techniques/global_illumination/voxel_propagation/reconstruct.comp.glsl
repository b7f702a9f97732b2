// SPDX-License-Identifier: BSD-3-Clause
// Light of each pixel's point from the voxels around it, whether it sees them or not.
#include "renderer/techniques/global_illumination/indirect_picture.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/gather_light.glsl"

vec3 indirectLight(SurfacePoint point, vec3 albedo) {
  const vec3 at = toVoxels(point.position) - 0.5;
  vec4 result = vec4(0.0);
  for (uint left = weightedFaces(point); left != 0u; left &= left - 1u) {
    uint doubtful;
    const vec4 sum = lightAtFace(point, at, findLSB(left), 0u, doubtful);
    if (sum.a > kLeastKnown) addFace(point, findLSB(left), sum, result);
  }
  return reflectedLight(result, albedo);
}
