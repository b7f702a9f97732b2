// SPDX-License-Identifier: BSD-3-Clause
// What each sample of the surfaces sends of the lamp's light and its own, added to its voxel as a cosine lobe.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kInjectSamplesUnit) uniform usampler2D samples;  // triangle, two weights, area over a face's
// Layer ((channel * 4) + coefficient) * depth + z, in units of 1 / kInjectFixed, signed.
layout(binding = kInjectSumsImage, r32ui) uniform uimage2DArray sums;

uniform ivec2 sizePx;
uniform uint sampleCount;
uniform float shift;  // in voxels
#include "renderer/techniques/global_illumination/surface_light.glsl"
#include "renderer/techniques/global_illumination/voxel_grid/light_lobes.glsl"
#include "renderer/voxels/volume.glsl"

ivec3 along(int axis, int steps) { return steps * ivec3(axis == 0, axis == 1, axis == 2); }

// Surfaces around it on all sides.
bool isEnclosed(ivec3 voxel) {
  if (!isOccupied(voxel)) return false;
  for (int face = 0; face < 6; ++face) {
    const ivec3 beside = voxel + along(face >> 1, (face & 1) == 0 ? 1 : -1);
    if (isInGrid(beside) && !isOccupied(beside)) return false;
  }
  return true;
}

// Where a surface's light starts. Voxels along the edges of rooms could send it into the next room alone; it starts in front of
// them, or beside that.
ivec3 startOf(SurfacePoint point) {
  const ivec3 first = clamp(ivec3(floor(toVoxels(point.position) + shift * point.flatNormal)), ivec3(0), gridSize() - 1);
#if EXCHANGE == EXCHANGE_OPEN
  if (!isEnclosed(first)) return first;
  const vec3 size = abs(point.flatNormal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const ivec3 forward = along(axis, dot(point.flatNormal, vec3(along(axis, 1))) > 0.0 ? 1 : -1);
  for (int tried = 0; tried < 6; ++tried) {
    ivec3 voxel = first + (tried == 1 ? 2 : 1) * forward;
    if (tried >= 2) voxel += along((axis + 1 + (tried >> 1 & 1)) % 3, (tried & 1) == 0 ? 1 : -1);
    if (isInGrid(voxel) && !isEnclosed(voxel)) return voxel;
  }
#endif
  return first;
}

void add(SurfacePoint point, vec3 radiance, float area) {
  if (radiance == vec3(0.0)) return;
  const ivec3 voxel = startOf(point);
  // The flux of a diffuse surface is pi times its radiance and area.
  const vec4 lobe = 3.14159265 * area * unitLobe(point.flatNormal, kCosineSlope);
  for (int channel = 0; channel < 3; ++channel)
    for (int c = 0; c < 4; ++c)
      imageAtomicAdd(sums, ivec3(voxel.xy, (4 * channel + c) * gridSizeZ + voxel.z),
                     uint(int(round(kInjectFixed * radiance[channel] * lobe[c]))));
}

void main() {
  const uint index = gl_GlobalInvocationID.y * uint(textureSize(samples, 0).x) + gl_GlobalInvocationID.x;
  if (gl_GlobalInvocationID.x >= uint(textureSize(samples, 0).x) || index >= sampleCount) return;
  const uvec4 texel = texelFetch(samples, ivec2(gl_GlobalInvocationID.xy), 0);
  const vec2 uv = uintBitsToFloat(texel.yz);
  const vec3 weights = vec3(1.0 - uv.x - uv.y, uv);
  const uvec3 vertices = sceneTriangle(texel.x);
  const vec3 a = scenePosition(vertices.x), e1 = scenePosition(vertices.y) - a, e2 = scenePosition(vertices.z) - a;
  // Scaled before the product: squares of a tiny scene's areas would leave float's range.
  const vec3 reach = max(abs(e1), abs(e2));
  const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
  const vec3 front = cross(e1 * unit, e2 * unit);
  if (!(dot(front, front) > 0.0)) return;
  const float area = uintBitsToFloat(texel.w);
  // Either side of the surface.
  SurfacePoint point = surfaceHit(texel.x, weights, -normalize(front));
  const vec3 albedo = reflectance(point);
  add(point, emitted(point) + albedo * lampRadiance(point), area);
  point = surfaceHit(texel.x, weights, normalize(front));
  add(point, albedo * lampRadiance(point), area);
}
