// SPDX-License-Identifier: BSD-3-Clause
// What a point of a triangle gives the voxel that it lies in. See VoxelAttribute.
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/pattern.glsl"
#include "renderer/ray_tracing/ray_tracing_bindings.h"
#include "renderer/voxels/volume.glsl"

#ifdef SUMS
layout(std430, binding = kSurfaceMaterialsBuffer) readonly buffer Materials { SurfaceMaterial surfaceMaterials[]; };
layout(std430, binding = kSurfaceTriangleMaterialsBuffer) readonly buffer TriangleMaterials { uint surfaceMaterialOf[]; };
uniform float largestLight;

float entryOpacity(SurfaceMaterial material) { return 1.0 - dot(material.transmittance, vec3(1.0 / 3.0)); }

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

// Clamped cosine about the normal and about its opposite: sqrt(pi) / 2, and sqrt(pi / 3) times y, z and x.
vec4 entryLobe(float front, float back, vec3 normal) {
  return vec4(0.88622693 * (front + back), 1.02332671 * (front - back) * normal.yzx);
}
const vec3 kLuminance = vec3(0.2126, 0.7152, 0.0722);
#endif
#endif
