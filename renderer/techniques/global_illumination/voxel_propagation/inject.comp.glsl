// SPDX-License-Identifier: BSD-3-Clause
// What each sample of the surfaces sends of the lamp's light and its own, added as a cosine lobe to the empty voxel in front of it.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kInjectSamplesUnit) uniform usampler2D samples;  // triangle, two weights, area over a face's
// Layer ((channel * 4) + component) * depth + z, in units of 1 / kInjectFixed, signed.
layout(binding = kInjectSumsImage, r32ui) uniform uimage2DArray sums;
layout(std430, binding = kInjectCountsBuffer) buffer Counts { InjectCounts counts; };

uniform ivec2 sizePx;
uniform uint sampleCount;
uniform float shift;  // in voxels
uniform int onlyAxis;  // of surfaces that face it; negative: all
#include "renderer/techniques/global_illumination/surface_light.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/light_bounds.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/light_lobes.glsl"

ivec3 along(int axis, int steps) { return steps * ivec3(axis == 0, axis == 1, axis == 2); }

int longestAxisOf(vec3 v) {
  const vec3 size = abs(v);
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

// Whether no surface is between the sample and a voxel's middle.
bool isSeen(SurfacePoint point, ivec3 voxel) {
  const vec3 middle = gridOrigin + (vec3(voxel) + 0.5) * voxelSize;
  return !rayAnyHit(Ray(point.position, middle - point.position, 0.0, 1.0, point.triangle));
}

// Where a surface's light starts: `shift` voxels in front of it; if that is occupied, farther; along the edges of rooms, where
// voxels in front are occupied as well, beside that. x < 0: nowhere.
ivec3 startOf(SurfacePoint point) {
  const vec3 at = toVoxels(point.position);
  const ivec3 first = ivec3(floor(at + shift * point.flatNormal));
  if (isOpen(first)) return first;
  for (int k = 1; k <= 3; ++k) {
    const ivec3 voxel = ivec3(floor(at + (shift + 0.5 * float(k)) * point.flatNormal));
    if (isOpen(voxel) && isSeen(point, voxel)) return voxel;
  }
  const int axis = longestAxisOf(point.flatNormal), u = (axis + 1) % 3, v = (axis + 2) % 3;
  const ivec3 forward = along(axis, point.flatNormal[axis] > 0.0 ? 1 : -1), own = ivec3(floor(at));
  ivec3 best = ivec3(-1);
  float nearest = 1e30;
  for (int depth = 1; depth <= 2; ++depth)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const ivec3 voxel = own + depth * forward + along(u, i) + along(v, j);
        const vec3 away = vec3(voxel) + 0.5 - at;
        const float distance2 = dot(away, away);
        if (distance2 >= nearest || !isOpen(voxel) || !isSeen(point, voxel)) continue;
        nearest = distance2;
        best = voxel;
      }
  return best;
}

void add(SurfacePoint point, vec3 radiance, float area) {
  if (radiance == vec3(0.0)) return;
  const ivec3 voxel = startOf(point);
  if (voxel.x < 0) {
    atomicAdd(counts.homeless, 1u);
    return;
  }
  // The flux of a diffuse surface is pi times its radiance and area.
  const vec4 lobe = 3.14159265 * area * cosineLobe(point.flatNormal);
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
  if (onlyAxis >= 0 && longestAxisOf(front) != onlyAxis) return;
  const float area = uintBitsToFloat(texel.w);
  // Either side of the surface.
  SurfacePoint point = surfaceHit(texel.x, weights, -normalize(front));
  if (!isInGrid(ivec3(floor(toVoxels(point.position))))) return;
  const vec3 albedo = reflectance(point);
  add(point, emitted(point) + albedo * lampRadiance(point), area);
  point = surfaceHit(texel.x, weights, normalize(front));
  add(point, albedo * lampRadiance(point), area);
}
