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

vec4 lightOf(ivec3 voxel, int face) { return texelFetch(arrived, voxel + ivec3(0, 0, face * gridSizeZ), 0); }

const float kLeastShare = 1e-5;  // less is rounding of the position

float cornerShare(vec3 part, ivec3 upper) {
  const vec3 axes = mix(1.0 - part, part, vec3(upper));
  return axes.x * axes.y * axes.z;
}

#if INTERPOLATION == INTERPOLATION_VISIBLE
uniform int widest;  // voxels around that are looked at for light of crevices

// Whether no surface is between a point and the middle of the empty voxel beyond a face.
bool seesVoxel(SurfacePoint point, ivec3 voxel) {
  const vec3 middle = gridOrigin + (vec3(voxel) + 0.5) * voxelSize;
  return !rayAnyHit(Ray(point.position, middle - point.position, 0.0, 1.0, point.triangle));
}

// Voxels of the 8 around a point of which it surely sees what is beyond, so that no ray is needed: there is one wall alone in its own
// voxel and in them, what is in front of its own voxel is empty, and so is the way from there to a neighbour, or both ways to a
// diagonal one are.
struct Surroundings {
  ivec3 own;
  bool open, openU, openV;
};
Surroundings surroundingsOf(ivec3 low, vec3 part, int face) {
  const int axis = face >> 1;
  const ivec3 u = ivec3(axis == 2, axis == 0, axis == 1), v = ivec3(axis == 1, axis == 2, axis == 0);
  const ivec3 upper = ivec3(greaterThanEqual(part, vec3(0.5))), own = low + upper, other = 1 - 2 * upper;
  const uint cell = cellAt(own), besideU = cellAt(own + u * other), besideV = cellAt(own + v * other);
  return Surroundings(own, !besideSurface(cell, face) && !holdsEdge(cell), !besideSurface(besideU, face),
                      !besideSurface(besideV, face));
}
bool isSurelySeen(Surroundings near, ivec3 voxel, int face) {
  const int axis = face >> 1;
  const ivec3 away = voxel - near.own;
  if (away[axis] != 0 || !near.open || holdsEdge(cellAt(voxel))) return false;
  return away[(axis + 1) % 3] == 0 || away[(axis + 2) % 3] == 0 || (near.openU && near.openV);
}
#endif

// Mean light at one face of the voxels around; alpha: 0 where there is none. `wide`: of a point for which there was none, as in
// crevices lower than a voxel, the nearest light farther around.
vec4 lightAtFace(SurfacePoint point, vec3 at, int face, bool wide) {
  const ivec3 low = ivec3(floor(at)), last = gridSize() - 1;
  const vec3 part = at - vec3(low);
  // All that the 8 voxels hold at once: what is fetched one after another is waited for one after another.
  vec4 lights[8];
  for (int corner = 0; corner < 8; ++corner)
    lights[corner] = lightOf(clamp(low + ivec3(corner & 1, corner >> 1 & 1, corner >> 2), ivec3(0), last), face);
#if INTERPOLATION == INTERPOLATION_VISIBLE
  const Surroundings near = surroundingsOf(low, part, face);
#endif
  vec4 sum = vec4(0.0);
  uint doubtful = 0u;
  for (int corner = 0; corner < 8; ++corner) {
    const ivec3 upper = ivec3(corner & 1, corner >> 1 & 1, corner >> 2), voxel = low + upper;
    float share = cornerShare(part, upper);
    if (!(share > kLeastShare) || !isInGrid(voxel)) continue;
    vec4 light = lights[corner];
#if GATHER == GATHER_FACES && INTERPOLATION != INTERPOLATION_ALL
    share *= light.a;
#elif INTERPOLATION != INTERPOLATION_ALL
    if (!holdsSurface(cellAt(voxel))) continue;
#endif
#if INTERPOLATION == INTERPOLATION_VISIBLE
    if (light.a > 0.0 && !isSurelySeen(near, voxel, face)) {
      doubtful |= 1u << corner;
      continue;
    }
#endif
#if GATHER == GATHER_REFLECTED
    light.rgb *= texelFetch(volumeAlbedo, voxel, 0).rgb;
#endif
    sum += share * vec4(light.rgb, 1.0);
  }
#if INTERPOLATION == INTERPOLATION_VISIBLE
  // The doubtful ones that the point sees; if there is none at all, the nearest seen of those farther around, in ever wider cubes. One
  // place in the shader traces rays, as each takes many registers.
  const ivec3 own = ivec3(floor(at + 0.5));
  float nearest = 1e30;
  int reach = wide ? 2 : 1, side = 2 * reach + 1;
  if (wide) sum = vec4(0.0);
  for (int i = doubtful != 0u && !wide ? 0 : 8;; ++i) {
    if (i >= 8 + side * side * side) {
      if (!wide || nearest < 1e29 || reach >= widest) break;
      ++reach, side += 2, i = 8;
    }
    const bool around = i >= 8;
    if (around ? sum.a > 1e-4 && nearest > 1e29 : (doubtful >> i & 1u) == 0u) {
      if (around) break;
      continue;
    }
    const int j = i - 8;
    const ivec3 upper = ivec3(i & 1, i >> 1 & 1, i >> 2), from = ivec3(j % side, j / side % side, j / (side * side)) - reach;
    const ivec3 voxel = around ? own + from : low + upper;
    const vec3 away = vec3(voxel) - at;
    if (around && (dot(away, away) >= nearest || !isInGrid(voxel))) continue;
    if (wide && max(max(abs(from.x), abs(from.y)), abs(from.z)) < reach) continue;
    // What is below the surface does not light it.
    if (!(dot(away + vec3(faceStep(face)), point.flatNormal) > 0.0)) continue;
    vec4 light = lightOf(voxel, face);
    if (light.a == 0.0 || !seesVoxel(point, voxel + faceStep(face))) continue;
#if GATHER == GATHER_REFLECTED
    light.rgb *= texelFetch(volumeAlbedo, voxel, 0).rgb;
#endif
    if (around) {
      nearest = dot(away, away);
      sum = vec4(light.rgb, 1.0);
    } else {
      sum += cornerShare(part, upper) * vec4(light.rgb, 1.0);
    }
  }
#endif
  return sum.a > 1e-4 ? vec4(sum.rgb / sum.a, 1.0) : vec4(0.0);
}

vec3 indirectLight(SurfacePoint point, vec3 albedo) {
  const vec3 at = toVoxels(point.position) - 0.5;
  vec3 result = vec3(0.0);
  float known = 0.0;
#if GATHER == GATHER_REFLECTED
  albedo = vec3(1.0);
#endif
  bool found = false;
  uint faces = 0u;
  for (int face = 0; face < 6; ++face)
    if (faceWeight(dot(point.flatNormal, vec3(faceStep(face)))) != 0.0) faces |= 1u << face;
  // Not unrolled, so that rays stay in one place.
  uint left = faces;
  bool wide = false;
  for (;;) {
    if (left == 0u) {
#if INTERPOLATION == INTERPOLATION_VISIBLE
      if (wide || found || widest < 2) break;
      wide = true;
      left = faces;
      continue;
#else
      break;
#endif
    }
    const int face = findLSB(left);
    left &= left - 1u;
    const float weight = faceWeight(dot(point.flatNormal, vec3(faceStep(face))));
    const vec4 light = lightAtFace(point, at, face, wide);
    result += weight * light.rgb;
    known += weight * light.a;
    found = found || light.a > 0.0;
  }
#if GATHER == GATHER_FACES
  return known > 1e-4 ? albedo * result / (known * 3.14159265) : vec3(0.0);
#else
  return albedo * max(result, 0.0) / 3.14159265;
#endif
}
