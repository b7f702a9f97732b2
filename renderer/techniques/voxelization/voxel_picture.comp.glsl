// SPDX-License-Identifier: BSD-3-Clause
// The first occupied voxel along each pixel's ray.
#include "renderer/frame/seen_point.glsl"
#include "renderer/techniques/voxelization/voxelization_bindings.h"
#include "renderer/voxels/volume.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kVoxelPictureImage, rgba32f) uniform writeonly image2D pictureImage;
uniform ivec2 sizePx;
uniform vec2 rayScale;
uniform mat4 cameraToAnchor;

const vec3 kBackground = vec3(0.05);

vec3 shadedVoxel(ivec3 voxel, vec3 sideNormal, vec3 direction) {
#ifdef VOLUME_LIGHT
  return texelFetch(volumeLight, storedVoxel(voxel), 0).xyz + 0.1 * texelFetch(volumeAlbedo, storedVoxel(voxel), 0).xyz;
#endif
  vec3 albedo = vec3(0.7), normal = sideNormal;
#ifdef VOLUME_ALBEDO
  albedo = texelFetch(volumeAlbedo, storedVoxel(voxel), 0).xyz;
#endif
#ifdef VOLUME_NORMAL
  const vec3 mean = texelFetch(volumeNormal, storedVoxel(voxel), 0).xyz;
  // Opposite sides of a thin wall cancel.
  if (dot(mean, mean) > 0.01) normal = normalize(mean);
#endif
  if (dot(normal, direction) > 0.0) normal = -normal;
  const vec3 light = normalize(vec3(0.5, 1.0, 0.3));
  return albedo * (0.4 + 0.6 * max(dot(normal, light), 0.0));
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec3 direction = normalize(mat3(cameraToAnchor) * pixelRay(pixel, rayScale, sizePx));
  const vec3 origin = toVoxels(cameraToAnchor[3].xyz);
  const vec3 speed = mix(direction, vec3(1e-20), equal(direction, vec3(0.0)));
  const vec3 to0 = -origin / speed, to1 = (vec3(gridSize()) - origin) / speed;
  const vec3 enters = min(to0, to1), leaves = max(to0, to1);
  const float begin = max(0.0, max(enters.x, max(enters.y, enters.z))), end = min(leaves.x, min(leaves.y, leaves.z));
  vec3 colour = kBackground;
  if (begin < end) {
    const ivec3 step_ = ivec3(sign(speed));
    ivec3 voxel = clamp(ivec3(floor(origin + begin * direction)), ivec3(0), gridSize() - 1);
    vec3 next = (vec3(voxel) + vec3(greaterThan(speed, vec3(0.0))) - origin) / speed;
    int axis = enters.x >= enters.y && enters.x >= enters.z ? 0 : enters.y >= enters.z ? 1 : 2;
    const int most = gridSizeX + gridSizeY + gridSizeZ + 3;
    for (int i = 0; i < most; ++i) {
      if (isOccupied(voxel)) {
        vec3 side = vec3(0.0);
        side[axis] = -float(step_[axis]);
        colour = shadedVoxel(voxel, side, direction);
        break;
      }
      axis = next.x <= next.y && next.x <= next.z ? 0 : next.y <= next.z ? 1 : 2;
      voxel[axis] += step_[axis];
      next[axis] += abs(1.0 / speed[axis]);
      if (!isInGrid(voxel)) break;
    }
  }
  imageStore(pictureImage, pixel, vec4(colour, 1.0));
}
