// SPDX-License-Identifier: BSD-3-Clause
// What a triangle adds to the sums of a voxel that it enters. See VoxelAttribute.
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/pattern.glsl"
#include "renderer/ray_tracing/ray_tracing_bindings.h"
#include "renderer/voxels/voxel_triangle.glsl"

#ifdef SUMS
layout(std430, binding = kSurfaceMaterialsBuffer) readonly buffer Materials { SurfaceMaterial surfaceMaterials[]; };
layout(std430, binding = kSurfaceTriangleMaterialsBuffer) readonly buffer TriangleMaterials { uint surfaceMaterialOf[]; };
layout(std430, binding = kVoxelSumsBuffer) buffer Sums { uint voxelSums[]; };
uniform float sumSteps, lightSteps, largestLight;

vec3 entryAlbedo(SurfaceMaterial material, vec3 position) {
#ifdef PATTERN
  if (material.pattern == kPatternNone) return material.albedo;
  const vec3 at = (position - material.patternOrigin) * material.patternFrequency;
  const float s = material.pattern == kPatternChecker ? checker(at) : fractalNoise(at, material.patternOctaves);
  return clamp(material.albedo * (1.0 + material.patternContrast * s), 0.0, 1.0);
#else
  return material.albedo;
#endif
}

#ifdef VOXEL_LIT
uniform int lampCount;
uniform vec3 lampPositions[kVoxelLamps];  // relative to the anchor
uniform float lampStrength;

#ifdef TRACED
#include "renderer/ray_tracing/trace.glsl"
bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) { return true; }

// Share of a lamp's light that arrives at a point of a triangle, off the surface on its lit side.
vec3 lampShare(vec3 position, vec3 lamp, uint id) {
  Ray ray = Ray(position, lamp - position, 0.0, 1.0, id);
#ifdef TRANSPARENT
  vec3 share = vec3(1.0);
  for (int passage = 0; passage <= MOST_PASSAGES; ++passage) {
    const RayHit hit = rayClosestHit(ray);
    if (hit.triangle == kRayNoTriangle) return share;
    share *= surfaceMaterials[surfaceMaterialOf[hit.triangle]].transmittance;
    if (share == vec3(0.0)) return share;
    ray.origin += hit.t * ray.direction;
    ray.direction = lamp - ray.origin;
    ray.skipped = hit.triangle;
  }
  return vec3(0.0);
#else
  return vec3(rayAnyHit(ray) ? 0.0 : 1.0);
#endif
}
#else
vec3 lampShare(vec3 position, vec3 lamp, uint id) { return vec3(1.0); }
#endif

// Radiance that leaves the side of `normal` and the other one.
struct EntryLight {
  vec3 front, back;
};
EntryLight entryLight(SurfaceMaterial material, vec3 albedo, vec3 position, vec3 normal, uint id) {
  EntryLight light = EntryLight(material.emission, vec3(0.0));
  for (int i = 0; i < lampCount; ++i) {
    const vec3 away = lampPositions[i] - position;
    if (!(dot(away, away) > 0.0)) continue;
    const float cosine = dot(normal, normalize(away));
    if (cosine == 0.0) continue;
    const vec3 start = position + sign(cosine) * kVoxelRayOffset * voxelSize * normal;
    const vec3 radiance = lampStrength * abs(cosine) * albedo * lampShare(start, lampPositions[i], id);
    if (cosine > 0.0)
      light.front += radiance;
    else
      light.back += radiance;
  }
  return EntryLight(min(light.front, vec3(largestLight)), min(light.back, vec3(largestLight)));
}

// Clamped cosine about an axis: sqrt(pi) / 2, and sqrt(pi / 3) times y, z and x.
void addLobe(uint at, float front, float back, vec3 normal) {
  const float even = 0.88622693 * (front + back);
  const vec3 odd = 1.02332671 * (front - back) * normal;
  atomicAdd(voxelSums[at], uint(round(lightSteps * even)));
  atomicAdd(voxelSums[at + 1u], uint(int(round(lightSteps * odd.y))));
  atomicAdd(voxelSums[at + 2u], uint(int(round(lightSteps * odd.z))));
  atomicAdd(voxelSums[at + 3u], uint(int(round(lightSteps * odd.x))));
}
#endif

// `place`: a point of the triangle, in voxels.
void addEntry(ivec3 voxel, vec3 place, uint id, VoxelTriangle t) {
  const uint first = SUMS * uint(voxel.x + gridSizeX * (voxel.y + gridSizeY * voxel.z));
  const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[id]];
  const vec3 unit = t.reach > 0.0 ? normalize(t.normal / t.reach) : vec3(0.0);
  atomicAdd(voxelSums[first], 1u);
#ifdef SUM_OPACITY
  const float opacity = 1.0 - dot(material.transmittance, vec3(1.0 / 3.0));
  atomicAdd(voxelSums[first + SUM_OPACITY], uint(round(sumSteps * opacity)));
#endif
  const vec3 position = gridOrigin + voxelSize * place, albedo = entryAlbedo(material, position);
#ifdef VOLUME_ALBEDO
  const uvec3 share = uvec3(round(sumSteps * albedo));
  atomicAdd(voxelSums[first + SUM_ALBEDO], share.x);
  atomicAdd(voxelSums[first + SUM_ALBEDO + 1u], share.y);
  atomicAdd(voxelSums[first + SUM_ALBEDO + 2u], share.z);
#endif
#ifdef VOLUME_NORMAL
  const ivec3 normal = ivec3(round(sumSteps * unit));
  atomicAdd(voxelSums[first + SUM_NORMAL], uint(normal.x));
  atomicAdd(voxelSums[first + SUM_NORMAL + 1u], uint(normal.y));
  atomicAdd(voxelSums[first + SUM_NORMAL + 2u], uint(normal.z));
#endif
#ifdef VOXEL_LIT
  const EntryLight light = entryLight(material, albedo, position, unit, id);
#ifdef VOLUME_LIGHT
  const uvec3 sum = uvec3(round(lightSteps * min(light.front + light.back, vec3(largestLight))));
  atomicAdd(voxelSums[first + SUM_LIGHT], sum.x);
  atomicAdd(voxelSums[first + SUM_LIGHT + 1u], sum.y);
  atomicAdd(voxelSums[first + SUM_LIGHT + 2u], sum.z);
#endif
#ifdef VOLUME_SH_GREY
  const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
  addLobe(first + SUM_SH_GREY, dot(light.front, luminance), dot(light.back, luminance), unit);
#endif
#ifdef VOLUME_SH_RED
  addLobe(first + SUM_SH_RED, light.front.x, light.back.x, unit);
  addLobe(first + SUM_SH_GREEN, light.front.y, light.back.y, unit);
  addLobe(first + SUM_SH_BLUE, light.front.z, light.back.z, unit);
#endif
#endif
}
#endif
