// SPDX-License-Identifier: BSD-3-Clause
// Indirect light of each pixel's point from the light that arrived at the faces of the occupied voxels around it, and its direct
// light. Source: Gaitatzes 2012, section 5.5.3, equations 12 to 15.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kReconstructIdsUnit) uniform usampler2D triangleIds;
layout(binding = kReconstructArrivedUnit) uniform sampler2DArray arrived;
layout(binding = kReconstructOutImage, rgba32f) uniform writeonly image2D picture;

uniform ivec2 sizePx;
uniform bool withDirect, withIndirect;
#include "renderer/techniques/global_illumination/surface_light.glsl"
#include "renderer/voxels/volume.glsl"

// Light that a voxel's face adds to a surface of this cosine to it. By faces, squares of cosines: they sum to 1. By harmonics, the
// product of the surface's clamped cosine with the lobe that has arrived, a clamped cosine as well, scaled so that what
// arrives along the normal is the flux over the face: (1 + 2 cos) / 3.
#if GATHER == GATHER_FACES
// Below 1e-3 a component of the normal may be rounding, or adds a millionth.
float faceWeight(float cosine) { return cosine > 1e-3 ? cosine * cosine : 0.0; }
#else
float faceWeight(float cosine) { return (1.0 + 2.0 * cosine) / 3.0; }
#endif

#if INTERPOLATION == INTERPOLATION_VISIBLE
// Whether no surface is between a point and the middle of the empty voxel beyond a face.
bool seesVoxel(SurfacePoint point, ivec3 voxel) {
  const vec3 middle = gridOrigin + (vec3(voxel) + 0.5) * voxelSize;
  return !rayAnyHit(Ray(point.position, middle - point.position, 0.0, 1.0, point.triangle));
}
#endif

ivec3 faceStep(int face) {
  const int axis = face >> 1;
  return ((face & 1) == 0 ? 1 : -1) * ivec3(axis == 0, axis == 1, axis == 2);
}

// Mean light at one face of the voxels around; alpha: 0 where there is none.
vec4 lightAtFace(SurfacePoint point, vec3 at, int face) {
  const ivec3 low = ivec3(floor(at)), forward = faceStep(face);
  const vec3 part = at - vec3(low);
#if INTERPOLATION == INTERPOLATION_VISIBLE
  // Another wall that stands on this one may hide voxels of the 8: only then do rays decide.
  bool doubtful = false;
  for (int corner = 0; corner < 8; ++corner) {
    const ivec3 upper = ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
    if ((upper[face >> 1] == 1) != ((face & 1) == 0)) continue;
    doubtful = doubtful || (isOccupied(low + upper) && isOccupied(low + upper + forward));
  }
#endif
  vec4 sum = vec4(0.0);
  for (int corner = 0; corner < 8; ++corner) {
    const ivec3 upper = ivec3(corner & 1, corner >> 1 & 1, corner >> 2), voxel = low + upper;
    if (!isInGrid(voxel)) continue;
    const bool solid = isOccupied(voxel);
#if INTERPOLATION != INTERPOLATION_ALL
    if (!solid) continue;
#endif
    const vec3 axes = mix(1.0 - part, part, vec3(upper));
    float share = axes.x * axes.y * axes.z;
    if (!(share > 1e-5)) continue;  // no more than rounding of the position
    vec4 light = vec4(0.0);
    if (solid) light = texelFetch(arrived, voxel + ivec3(0, 0, face * gridSizeZ), 0);
#if GATHER == GATHER_FACES && INTERPOLATION != INTERPOLATION_ALL
    share *= light.a;
#elif GATHER == GATHER_REFLECTED
    if (solid) light.rgb *= texelFetch(volumeAlbedo, voxel, 0).rgb;
#endif
#if INTERPOLATION == INTERPOLATION_VISIBLE
    if (doubtful && light.a > 0.0 && share > 0.0 && !seesVoxel(point, voxel + forward)) continue;
#endif
    sum += share * vec4(light.rgb, 1.0);
  }
#if INTERPOLATION == INTERPOLATION_VISIBLE
  // None: the nearest of those farther around.
  if (!(sum.a > 1e-4)) {
    sum = vec4(0.0);
    const ivec3 own = ivec3(floor(at + 0.5));
    float nearest = 1e30;
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          const ivec3 voxel = own + ivec3(x, y, z);
          const vec3 away = vec3(voxel) - at;
          if (dot(away, away) >= nearest || !isInGrid(voxel) || !isOccupied(voxel)) continue;
          const vec4 light = texelFetch(arrived, voxel + ivec3(0, 0, face * gridSizeZ), 0);
          if (light.a == 0.0 || !seesVoxel(point, voxel + forward)) continue;
          nearest = dot(away, away);
          sum = vec4(light.rgb, 1.0);
        }
  }
#endif
  return sum.a > 1e-4 ? vec4(sum.rgb / sum.a, 1.0) : vec4(0.0);
}

// Reflected irradiance over pi.
vec3 gatheredLight(SurfacePoint point, vec3 albedo) {
  const vec3 at = toVoxels(point.position) - 0.5;
  vec3 result = vec3(0.0);
  float known = 0.0;
#if GATHER == GATHER_REFLECTED
  albedo = vec3(1.0);
#endif
  for (int face = 0; face < 6; ++face) {
    const int axis = face >> 1;
    const float weight = faceWeight((face & 1) == 0 ? point.flatNormal[axis] : -point.flatNormal[axis]);
    if (weight == 0.0) continue;
    const vec4 light = lightAtFace(point, at, face);
    result += weight * light.rgb;
    known += weight * light.a;
  }
#if GATHER == GATHER_FACES
  return known > 1e-4 ? albedo * result / (known * 3.14159265) : vec3(0.0);
#else
  return albedo * max(result, 0.0) / 3.14159265;
#endif
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
    if (withIndirect) colour += gatheredLight(point, albedo);
    if (rayCutShort) colour = vec3(uintBitsToFloat(0x7fc00000u));
  }
  imageStore(picture, pixel, vec4(colour, 1.0));
}
