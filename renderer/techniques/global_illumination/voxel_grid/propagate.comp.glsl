// SPDX-License-Identifier: BSD-3-Clause
// One step: each voxel takes what its six neighbours send it, passes it on if empty and reflects it if not.
// Source: Gaitatzes 2012, section 5.5.2, equation 11.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kPropagateGroup, local_size_y = kPropagateGroup, local_size_z = kPropagateGroup) in;
layout(binding = kPropagateFieldUnit) uniform sampler2DArray field;
layout(binding = kPropagateOutImage, FIELD_FORMAT) uniform writeonly image2DArray next;
layout(binding = kPropagateGatheredImage, FIELD_FORMAT) uniform image2DArray gathered;

uniform float coneConstant, coneLinear;  // harmonics of the cone towards a neighbour
uniform float coneSlope;                 // of linear to constant coefficient
uniform vec3 fixedAlbedo;
#include "renderer/techniques/global_illumination/voxel_grid/light_lobes.glsl"
#include "renderer/voxels/volume.glsl"

vec3 faceDirection(int face) {
  const int axis = face >> 1;
  const float side = (face & 1) == 0 ? 1.0 : -1.0;
  return side * vec3(axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0);
}

// What leaves `voxel` along a face's direction.
float faceFlux(ivec3 voxel, int layer, int face) {
  const vec4 light = texelFetch(field, ivec3(voxel.xy, layer), 0);
  if (light == vec4(0.0)) return 0.0;
  const vec3 slope = coneLinear * light.wyz;  // x, y, z
  const float flux = max(coneConstant * light.x + dot(slope, faceDirection(face)), 0.0);
  // Of the cones: all, those within the grid, those to empty voxels.
  float all = 0.0, within = 0.0, open = 0.0;
  for (int k = 0; k < 6; ++k) {
    const vec3 direction = faceDirection(k);
    const float part = max(coneConstant * light.x + dot(slope, direction), 0.0);
    const ivec3 beside = voxel + ivec3(direction);
    all += part;
    if (!isInGrid(beside)) continue;
    within += part;
    if (!isOccupied(beside)) open += part;
  }
#if EXCHANGE == EXCHANGE_OPEN
  // Surfaces light empty voxels alone. Those that others enclose, as in the corners of rooms, share their light with these, but
  // send none out of the grid.
  if (isOccupied(voxel)) {
    const bool hasEmpty = open > 1e-4 * all;
    if (hasEmpty && isOccupied(voxel + ivec3(faceDirection(face)))) return 0.0;
    all = hasEmpty ? open : within;
  }
#endif
#if SHARES == SHARES_PRINTED
  return flux;
#else
  // All of the voxel's flux leaves it, shared among its faces as the cones have it.
  return all > 0.0 ? flux * max(light.x, 0.0) * kFluxOfConstant / all : 0.0;
#endif
}

vec4 reflected(float flux, vec3 direction, vec3 normal) {
#if REFLECTION == REFLECTION_AXIS
  return flux * unitLobe(-direction, coneSlope);
#else
  if (!(dot(normal, normal) > 0.01)) return flux * unitLobe(-direction, coneSlope);
  const vec3 n = normalize(normal);
#if REFLECTION == REFLECTION_NORMAL
  return flux * unitLobe(reflect(direction, n), coneSlope);
#else
  return flux * unitLobe(dot(direction, n) > 0.0 ? -n : n, kCosineSlope);
#endif
#endif
}

void main() {
  const ivec3 at = ivec3(gl_GlobalInvocationID);  // z: channel and layer
  if (any(greaterThanEqual(at, ivec3(gridSize().xy, 3 * gridSizeZ)))) return;
  const int channel = at.z / gridSizeZ;
  const ivec3 voxel = ivec3(at.xy, at.z - channel * gridSizeZ);
  const bool solid = isOccupied(voxel);
  const vec4 surface = texelFetch(volumeNormal, voxel, 0);
  const float opacity = solid ? surface.w : 0.0;
#if ALBEDO == ALBEDO_STORED
  const float albedo = solid ? texelFetch(volumeAlbedo, voxel, 0)[channel] : 0.0;
#else
  const float albedo = fixedAlbedo[channel];
#endif
  vec4 passing = vec4(0.0), incident = vec4(0.0), back = vec4(0.0);
  for (int face = 0; face < 6; ++face) {
    const vec3 direction = faceDirection(face);
    const ivec3 from = voxel - ivec3(direction);
    if (!isInGrid(from)) continue;
    const float flux = faceFlux(from, from.z + channel * gridSizeZ, face);
    if (flux == 0.0) continue;
    const vec4 lobe = flux * unitLobe(direction, coneSlope);
    passing += (1.0 - opacity) * lobe;
    if (!solid) continue;
    incident += lobe;
    back += reflected(albedo * flux, direction, surface.xyz);
  }
  // A voxel holds what surfaces in it absorb and reflect; transparent ones keep their diffuse share.
  imageStore(next, at, passing + (opacity > 0.0 ? back : vec4(0.0)));
  if (solid) imageStore(gathered, at, imageLoad(gathered, at) + incident);
}
