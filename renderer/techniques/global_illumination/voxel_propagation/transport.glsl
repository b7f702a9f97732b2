// SPDX-License-Identifier: BSD-3-Clause
// How much of a voxel's light leaves it through a face, and with which directions. Faces: 2 * axis, + 1 on the low side.
#include "renderer/techniques/global_illumination/illumination_bindings.h"
#include "renderer/techniques/global_illumination/voxel_propagation/light_lobes.glsl"

vec3 faceDirection(int face) {
  const int axis = face >> 1;
  return (face & 1) == 0 ? vec3(axis == 0, axis == 1, axis == 2) : -vec3(axis == 0, axis == 1, axis == 2);
}

#if TRANSPORT == TRANSPORT_MOMENTS
layout(binding = kShareTableUnit) uniform sampler3D shareTable;  // see lobe_shares.h

// Without branches, so that all fetches of a step are under way at once.
vec4 leaving(vec4 light, int face) {
  const float flux = max(light.x, 0.0), reach = length(light.yzw);
  const vec3 u = reach > 0.0 ? light.yzw / reach : vec3(1.0, 0.0, 0.0);
  const vec3 side = mix(vec3(-1.0), vec3(1.0), greaterThanEqual(u, vec3(0.0))), size = abs(u);
  const float across = size.x + size.y, level = flux > 0.0 ? min(reach / flux, 1.0) * float(kShareLevels - 1) : 0.0;
  const int axis = face >> 1, block = 2 * axis + (((face & 1) == 0) == (side[axis] > 0.0) ? 0 : 1);
  const vec3 at = vec3(float(kShareSide - 1) * vec2(size.x / max(across, 1e-6), size.z / (across + size.z)),
                       level + float(block * kShareLevels)) + 0.5;
  const vec4 share = textureLod(shareTable, at / vec3(kShareSide, kShareSide, kShareLevels * 6), 0.0);
  return flux * vec4(share.x, side * share.yzw);
}
#elif TRANSPORT == TRANSPORT_FACES
// Intensity, without the factor 1 / 4 pi.
float intensity(vec4 light, vec3 direction) { return max(light.x + 3.0 * dot(light.yzw, direction), 0.0); }

// Solid angles of a cube's far faces seen from the middle of a neighbour: the face opposite, and each of the sides.
const float kFrontAngle = 0.400669, kSideAngle = 0.423431;

// Through all far faces of the neighbour beyond `face`.
vec4 towards(vec4 light, int face) {
  const vec3 forward = faceDirection(face);
  float flux = kFrontAngle * intensity(light, forward);
  vec4 sum = flux * cosineLobe(forward);
  for (int other = 0; other < 6; ++other) {
    if (other >> 1 == face >> 1) continue;
    const vec3 side = faceDirection(other);
    flux = kSideAngle * intensity(light, (forward + 0.5 * side) * 0.894427191);
    sum += flux * cosineLobe(side);
  }
  return sum;
}

vec4 leaving(vec4 light, int face) {
  if (!(light.x > 0.0)) return vec4(0.0);
  float all = 0.0;
  for (int other = 0; other < 6; ++other) all += towards(light, other).x;
  return towards(light, face) * (light.x / all);
}
#else
// Integrals of the harmonics over the cone, as moments: share of the sphere, and what a vector along the axis adds to it; length of
// the vector of the cone's own harmonics; a factor.
uniform float coneShare, coneSlope, coneDirection, coneScale;

vec4 leaving(vec4 light, int face) {
  const vec3 forward = faceDirection(face);
#if TRANSPORT == TRANSPORT_CONES
  const float flux = max(coneShare * light.x + coneSlope * dot(light.yzw, forward), 0.0);
  return coneScale * flux * vec4(1.0, coneDirection * forward);
#else
  return coneScale * vec4(coneShare * light.x, coneSlope * light.yzw * forward);
#endif
}
#endif
