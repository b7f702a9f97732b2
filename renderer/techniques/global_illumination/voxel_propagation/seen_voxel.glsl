// SPDX-License-Identifier: BSD-3-Clause
// Whether no surface is between a point and the middle of an empty voxel. After gather_light.glsl.
bool seesVoxel(SurfacePoint point, ivec3 voxel) {
  const vec3 middle = gridOrigin + (vec3(voxel) + 0.5) * voxelSize;
  return !rayAnyHit(Ray(point.position, middle - point.position, 0.0, 1.0, point.triangle));
}
