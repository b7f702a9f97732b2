// SPDX-License-Identifier: BSD-3-Clause
// Indirect light of each pixel's point from the light that arrived at the faces of the occupied voxels around it, and its direct
// light. Source: Gaitatzes 2012, section 5.5.3, equations 12 to 15.
#include "renderer/techniques/global_illumination/indirect_picture.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/light_cells.glsl"
#include "renderer/voxels/volume.glsl"

layout(binding = kReconstructArrivedUnit) uniform sampler2DArray arrived;

// Light that a voxel's face adds to a surface of this cosine to it. By faces, squares of cosines: they sum to 1. By harmonics, the
// product of the surface's clamped cosine with the lobe that has arrived, a clamped cosine as well, scaled so that what
// arrives along the normal is the flux over the face: (1 + 2 cos) / 3.
#if GATHER == GATHER_FACES
// Below 1e-3 a component of the normal may be rounding, or adds a millionth.
float faceWeight(float cosine) { return cosine > 1e-3 ? cosine * cosine : 0.0; }
#else
float faceWeight(float cosine) { return (1.0 + 2.0 * cosine) / 3.0; }
#endif

ivec3 faceStep(int face) {
  const int axis = face >> 1;
  return ((face & 1) == 0 ? 1 : -1) * ivec3(axis == 0, axis == 1, axis == 2);
}

uint cellAt(ivec3 voxel) { return isInGrid(voxel) ? texelFetch(lightCells, voxel, 0).x : 0u; }

vec4 lightOf(ivec3 voxel, int face) {
  vec4 light = texelFetch(arrived, voxel + ivec3(0, 0, face * gridSizeZ), 0);
#if GATHER == GATHER_REFLECTED
  light.rgb *= texelFetch(volumeAlbedo, voxel, 0).rgb;
#endif
  return light;
}

// The 8 voxels around the point, with its place between them.
ivec3 low = ivec3(0);
vec3 part = vec3(0.0);
uint cells[8] = uint[8](0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
ivec3 cornerStep(int corner) { return ivec3(corner & 1, corner >> 1 & 1, corner >> 2); }
float cornerShare(int corner) {
  const vec3 axes = mix(1.0 - part, part, vec3(cornerStep(corner)));
  return axes.x * axes.y * axes.z;
}
const float kLeastShare = 1e-5;  // less is rounding of the position

// Mean light at one face of those whose bit is set; alpha: 0 where there is none.
vec4 meanLight(int face, uint usable) {
  const ivec3 last = gridSize() - 1;
  // All at once: what is fetched one after another is waited for one after another.
  vec4 lights[8];
  for (int corner = 0; corner < 8; ++corner) lights[corner] = lightOf(clamp(low + cornerStep(corner), ivec3(0), last), face);
  vec4 sum = vec4(0.0);
  for (int corner = 0; corner < 8; ++corner) {
    float share = cornerShare(corner);
    if ((usable >> corner & 1u) == 0u || !(share > kLeastShare) || !isInGrid(low + cornerStep(corner))) continue;
#if GATHER == GATHER_FACES && INTERPOLATION != INTERPOLATION_ALL
    share *= lights[corner].a;
#elif INTERPOLATION != INTERPOLATION_ALL
    if (!holdsSurface(cells[corner])) continue;
#endif
    sum += share * vec4(lights[corner].rgb, 1.0);
  }
  return sum.a > 1e-4 ? vec4(sum.rgb / sum.a, 1.0) : vec4(0.0);
}
float weightOf(SurfacePoint point, int face) { return faceWeight(dot(point.flatNormal, vec3(faceStep(face)))); }

#if INTERPOLATION == INTERPOLATION_VISIBLE
#include "renderer/techniques/global_illumination/voxel_propagation/seen_voxels.glsl"
#endif

vec3 indirectLight(bool there, SurfacePoint point, vec3 albedo) {
  const vec3 at = there ? toVoxels(point.position) - 0.5 : vec3(0.0);
  low = ivec3(floor(at));
  part = at - vec3(low);
  uint faces = 0u;
  if (there) {
    for (int corner = 0; corner < 8; ++corner) cells[corner] = cellAt(low + cornerStep(corner));
    for (int face = 0; face < 6; ++face)
      if (weightOf(point, face) != 0.0) faces |= 1u << face;
  }
#if INTERPOLATION == INTERPOLATION_VISIBLE
  const vec4 result = seenLight(point, at, faces);
#else
  vec4 result = vec4(0.0);
  for (uint left = faces; left != 0u; left &= left - 1u) result += weightOf(point, findLSB(left)) * meanLight(findLSB(left), 0xffu);
#endif
#if GATHER == GATHER_REFLECTED
  albedo = vec3(1.0);
#endif
#if GATHER == GATHER_FACES
  return result.a > 1e-4 ? albedo * result.rgb / (result.a * 3.14159265) : vec3(0.0);
#else
  return albedo * max(result.rgb, 0.0) / 3.14159265;
#endif
}
