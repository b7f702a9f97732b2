// SPDX-License-Identifier: BSD-3-Clause
// Indirect light of each pixel's point from the light gathered in the occupied voxels around it, and its direct light.
// Source: Gaitatzes 2012, section 5.5.3, equations 12 to 15.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kReconstructIdsUnit) uniform usampler2D triangleIds;
layout(binding = kReconstructGatheredUnit) uniform sampler2DArray gathered;
layout(binding = kReconstructOutImage, rgba32f) uniform writeonly image2D picture;

uniform ivec2 sizePx;
uniform bool withDirect, withIndirect, occupiedOnly;
#include "renderer/techniques/global_illumination/surface_light.glsl"
#include "renderer/techniques/global_illumination/voxel_grid/light_lobes.glsl"
#include "renderer/voxels/volume.glsl"

// Irradiance over pi. The factor makes what arrives along the normal through a voxel's face, spread as the cone's lobe is, the
// flux over that face.
vec3 gatheredLight(SurfacePoint point) {
  const vec3 at = toVoxels(point.position) - 0.5;
  const ivec3 low = ivec3(floor(at));
  const vec3 part = at - vec3(low);
  const vec4 towards = 3.14159265 * unitLobe(-point.flatNormal, kCosineSlope);
  vec3 sum = vec3(0.0);
  float total = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const ivec3 upper = ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
    const ivec3 voxel = low + upper;
    if (!isInGrid(voxel) || (occupiedOnly && !isOccupied(voxel))) continue;
    const vec3 axes = mix(1.0 - part, part, vec3(upper));
    const float weight = axes.x * axes.y * axes.z;
    total += weight;
    sum += weight * vec3(dot(texelFetch(gathered, voxel, 0), towards),
                         dot(texelFetch(gathered, voxel + ivec3(0, 0, gridSizeZ), 0), towards),
                         dot(texelFetch(gathered, voxel + ivec3(0, 0, 2 * gridSizeZ), 0), towards));
  }
  return total > 1e-4 ? max(sum / total, 0.0) * 1.5 / 3.14159265 : vec3(0.0);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(triangleIds, pixel, 0).x;
  vec3 colour = vec3(0.0);
  if (id != kRayNoTriangle) {
    SeenPoint seen;
    const SurfacePoint point = surfaceSeen(pixel, id, seen);
    const vec3 albedo = reflectance(point);
    if (withDirect) colour += emitted(point) + albedo * lampRadiance(point);
    if (withIndirect) colour += albedo * gatheredLight(point);
    if (rayCutShort) colour = vec3(uintBitsToFloat(0x7fc00000u));
  }
  imageStore(picture, pixel, vec4(colour, 1.0));
}
