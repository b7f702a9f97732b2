// SPDX-License-Identifier: BSD-3-Clause
// What each sample of the surfaces sends of the lamp's light and its own, added as a cosine lobe to the empty voxel in front of it.
#include "renderer/techniques/global_illumination/surface_samples.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/light_bounds.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/light_lobes.glsl"

// Layer ((channel * 4) + component) * depth + z, in units of 1 / kInjectFixed, signed.
layout(binding = kInjectSumsImage, r32ui) uniform uimage2DArray sums;
layout(std430, binding = kInjectCountsBuffer) buffer Counts { InjectCounts counts; };

uniform float shift;  // in voxels
uniform int onlyAxis;  // of surfaces that face it; negative: all

ivec3 along(int axis, int steps) { return steps * ivec3(axis == 0, axis == 1, axis == 2); }

int longestAxisOf(vec3 v) {
  const vec3 size = abs(v);
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

bool takesSample(vec3 front) { return onlyAxis < 0 || longestAxisOf(front) == onlyAxis; }

// Places where a surface's light may start: `shift` voxels in front of it; if that is occupied, farther, where it is seen from the
// surface; along the edges of rooms, where voxels in front are occupied as well, the nearest one seen beside that.
const int kFartherPlaces = 3, kPlaces = 1 + kFartherPlaces + 2 * 9;
ivec3 placeOf(SurfacePoint point, vec3 at, int place) {
  if (place <= kFartherPlaces) return ivec3(floor(at + (shift + 0.5 * float(place)) * point.flatNormal));
  const int axis = longestAxisOf(point.flatNormal), i = place - kFartherPlaces - 1;
  const ivec3 forward = along(axis, point.flatNormal[axis] > 0.0 ? 1 : -1);
  return ivec3(floor(at)) + (1 + i / 9) * forward + along((axis + 1) % 3, i % 3 - 1) + along((axis + 2) % 3, i / 3 % 3 - 1);
}

void addSide(SurfacePoint point, vec3 albedo, float area) {
  const vec3 at = toVoxels(point.position);
  if (!isInGrid(ivec3(floor(at)))) return;
  vec3 radiance = emitted(point), lamp = vec3(0.0);
#ifdef TRANSPARENT
  radiance += albedo * lampRadiance(point);
#else
  lamp = albedo * unblockedLampRadiance(point);
#endif
  const bool lit = lamp != vec3(0.0);
  if (!lit && radiance == vec3(0.0)) return;
  ivec3 start = ivec3(-1);
  float nearest = 1e30;
  // First the lamp, then the places. One place in the shader traces rays, as each takes many registers.
  for (int place = lit ? -1 : 0; place < kPlaces; ++place) {
    vec3 target = lightPosition;
    ivec3 voxel = ivec3(-1);
    float distance2 = 0.0;
    if (place >= 0) {
      voxel = placeOf(point, at, place);
      const vec3 away = vec3(voxel) + 0.5 - at;
      distance2 = place > kFartherPlaces ? dot(away, away) : 0.0;
      if (distance2 >= nearest || !isOpen(voxel)) continue;
      if (place == 0) {
        start = voxel;
        break;
      }
      target = gridOrigin + (vec3(voxel) + 0.5) * voxelSize;
    }
    const bool blocked = rayAnyHit(Ray(point.position, target - point.position, 0.0, 1.0, point.triangle));
    if (place < 0) {
      if (!blocked) radiance += lamp;
      if (radiance == vec3(0.0)) return;
    } else if (!blocked) {
      start = voxel;
      nearest = distance2;
      if (place <= kFartherPlaces) break;
    }
  }
  if (start.x < 0) {
    atomicAdd(counts.homeless, 1u);
    return;
  }
  // The flux of a diffuse surface is pi times its radiance and area.
  const vec4 lobe = 3.14159265 * area * cosineLobe(point.flatNormal);
  for (int channel = 0; channel < 3; ++channel)
    for (int c = 0; c < 4; ++c)
      imageAtomicAdd(sums, ivec3(start.xy, (4 * channel + c) * gridSizeZ + start.z),
                     uint(wholeUnits(radiance[channel] * lobe[c])));
}
