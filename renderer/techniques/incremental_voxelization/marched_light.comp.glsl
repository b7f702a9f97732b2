// SPDX-License-Identifier: BSD-3-Clause
// Light that surfaces reflect of each other once: rays from each pixel's point through the voxels to the first that is occupied,
// whose light counts if its surface faces the ray. All pixels have the same directions, evenly spread over the sphere and fixed
// in the world, so that nothing swims.
#include "renderer/techniques/incremental_voxelization/marched_light_bindings.h"
#include "renderer/incremental_voxels/seen_surface.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kVolumeNormalUnit) uniform sampler2DArray voxelNormals;
layout(binding = kMarchedVoxelLightUnit) uniform sampler2DArray voxelLights;
layout(binding = kMarchedPictureImage, rgba32f) uniform writeonly image2D pictureImage;
uniform int directions;
uniform float startVoxels;
#ifndef ATTRIBUTES
#error "light is an attribute"
#endif

const float kGoldenAngle = 2.39996323;

// Of the i-th of `directions` points of a spiral on the sphere.
vec3 directionOf(int i) {
  const float z = 1.0 - (2.0 * float(i) + 1.0) / float(directions), r = sqrt(max(1.0 - z * z, 0.0)), turn = kGoldenAngle * float(i);
  return vec3(r * cos(turn), r * sin(turn), z);
}

vec3 lightAlong(vec3 origin, vec3 direction) {
  const vec3 speed = mix(direction, vec3(1e-20), equal(direction, vec3(0.0)));
  const ivec3 step_ = ivec3(sign(speed));
  ivec3 voxel = ivec3(floor(origin));
  vec3 next = (vec3(voxel) + vec3(greaterThan(speed, vec3(0.0))) - origin) / speed;
  const int most = gridSizeX + gridSizeY + gridSizeZ;
  for (int i = 0; i < most && isInGrid(voxel); ++i) {
    if (isOccupied(voxel)) {
      const bool faces = dot(texelFetch(voxelNormals, storedVoxel(voxel), 0).xyz, direction) < 0.0;
      return faces ? texelFetch(voxelLights, storedVoxel(voxel), 0).xyz : vec3(0.0);
    }
    const int axis = next.x <= next.y && next.x <= next.z ? 0 : next.y <= next.z ? 1 : 2;
    voxel[axis] += step_[axis];
    next[axis] += abs(1.0 / speed[axis]);
  }
  return vec3(0.0);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, viewSizePx[0]))) return;
  const float depth = depthAt(0, pixel);
  vec3 light = vec3(0.0);
  if (depth > 0.0) {
    const vec3 place = (voxelsFromView[0] * vec4(viewNear[0] / depth * viewRay(0, pixel), 1.0)).xyz;
    const SeenSurface surface = surfaceOf(0, pixel, place);
    // Out of the voxels of its own surface.
    const vec3 size = abs(surface.normal), origin = place + surface.normal * (startVoxels / max(size.x, max(size.y, size.z)));
    for (int i = 0; i < directions; ++i) {
      const vec3 direction = directionOf(i);
      const float cosine = dot(direction, surface.normal);
      if (cosine > 0.0) light += cosine * lightAlong(origin, direction);
    }
    light *= surface.albedo * 4.0 / float(directions);
  }
  imageStore(pictureImage, pixel, vec4(light, 1.0));
}
