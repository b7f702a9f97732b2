// SPDX-License-Identifier: BSD-3-Clause
// What each sample of the surfaces sends of the lamp's light and its own, added to its voxel for the faces that it is turned to.
// Sides that send nothing count by their area.
#define DARK_SIDES
#include "renderer/techniques/global_illumination/surface_samples.glsl"
#include "renderer/voxels/volume.glsl"

layout(std430, binding = kFaceSumsBuffer) buffer Sums { uint faceSums[]; };  // kFaceSums a voxel

bool takesSample(vec3 front) { return true; }

void addSide(SurfacePoint point, vec3 albedo, float area) {
  const vec3 radiance = emitted(point) + albedo * lampRadiance(point);
  const ivec3 voxel = ivec3(floor(toVoxels(point.position)));
  if (!isInGrid(voxel)) return;
  for (int axis = 0; axis < 3; ++axis) {
    const float weight = area * abs(point.flatNormal[axis]);
    if (weight == 0.0) continue;
    const int face = 2 * axis + (point.flatNormal[axis] > 0.0 ? 0 : 1);
    const uint first = kFaceSums * uint(voxel.x + gridSizeX * (voxel.y + gridSizeY * voxel.z)) + 4u * uint(face);
    atomicAdd(faceSums[first], uint(wholeUnits(weight)));
    for (int channel = 0; channel < 3; ++channel)
      atomicAdd(faceSums[first + 1u + uint(channel)], uint(wholeUnits(weight * radiance[channel])));
  }
}
