// SPDX-License-Identifier: BSD-3-Clause
// What each sample of the surfaces sends of the lamp's light and its own, added to its voxel for the faces that it is turned to.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kInjectSamplesUnit) uniform usampler2D samples;  // triangle, two weights, area over a face's
layout(std430, binding = kFaceSumsBuffer) buffer Sums { uint faceSums[]; };  // kFaceSums a voxel

uniform ivec2 sizePx;
uniform uint sampleCount;
#include "renderer/techniques/global_illumination/surface_light.glsl"
#include "renderer/voxels/volume.glsl"

void add(SurfacePoint point, vec3 radiance, float area) {
  const ivec3 voxel = ivec3(floor(toVoxels(point.position)));
  if (!isInGrid(voxel)) return;
  for (int axis = 0; axis < 3; ++axis) {
    const float weight = area * abs(point.flatNormal[axis]);
    if (weight == 0.0) continue;
    const int face = 2 * axis + (point.flatNormal[axis] > 0.0 ? 0 : 1);
    const uint first = kFaceSums * uint(voxel.x + gridSizeX * (voxel.y + gridSizeY * voxel.z)) + 4u * uint(face);
    atomicAdd(faceSums[first], uint(round(kInjectFixed * weight)));
    for (int channel = 0; channel < 3; ++channel)
      atomicAdd(faceSums[first + 1u + uint(channel)], uint(round(kInjectFixed * weight * radiance[channel])));
  }
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
  SurfacePoint point = surfaceHit(texel.x, weights, -normalize(front));
  const vec3 albedo = reflectance(point);
  add(point, emitted(point) + albedo * lampRadiance(point), area);
  point = surfaceHit(texel.x, weights, normalize(front));
  add(point, albedo * lampRadiance(point), area);
}
