// SPDX-License-Identifier: BSD-3-Clause
// Indirect light of a point from the light that arrived at the faces of the occupied voxels around it. Source: Gaitatzes 2012, section
// 5.5.3, equations 12 to 15. After indirect_point.glsl.
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

float weightOf(SurfacePoint point, int face) { return faceWeight(dot(point.flatNormal, vec3(faceStep(face)))); }
uint weightedFaces(SurfacePoint point) {
  uint faces = 0u;
  for (int face = 0; face < 6; ++face)
    if (weightOf(point, face) != 0.0) faces |= 1u << face;
  return faces;
}

// Corners of the cube of 8 voxels around a point.
ivec3 cornerStep(int corner) { return ivec3(corner & 1, corner >> 1 & 1, corner >> 2); }

const float kLeastShare = 1e-5;  // less is rounding of the position

float cornerShare(vec3 part, int corner) {
  const vec3 axes = mix(1.0 - part, part, vec3(cornerStep(corner)));
  return axes.x * axes.y * axes.z;
}

const float kLeastKnown = 1e-4;  // sum of shares below which there is no light

#if INTERPOLATION == INTERPOLATION_VISIBLE
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
// Whether light can have arrived at a voxel's face: `arrived` is known there.
bool isLit(uint cell, int face) { return holdsSurface(cell) && besideLight(cell, face) && !besideSurface(cell, face); }
// Whether the middle of the voxel beyond a face is on the side of the surface that is lit.
bool isInFront(SurfacePoint point, vec3 at, ivec3 voxel, int face) {
  return dot(vec3(voxel + faceStep(face)) - at, point.flatNormal) > 0.0;
}
#endif

// Sum of the light at one face of the voxels around, by their shares, which are in alpha. Of those with light that the point may not see,
// which become `doubtful`, the ones that are known to be `seen` alone.
vec4 lightAtFace(SurfacePoint point, vec3 at, int face, uint seen, out uint doubtful) {
  const ivec3 low = ivec3(floor(at)), last = gridSize() - 1;
  const vec3 part = at - vec3(low);
  // All that the 8 voxels hold at once: what is fetched one after another is waited for one after another.
  vec4 lights[8];
  for (int corner = 0; corner < 8; ++corner) lights[corner] = lightOf(clamp(low + cornerStep(corner), ivec3(0), last), face);
#if INTERPOLATION == INTERPOLATION_VISIBLE
  const Surroundings near = surroundingsOf(low, part, face);
#endif
  vec4 sum = vec4(0.0);
  doubtful = 0u;
  for (int corner = 0; corner < 8; ++corner) {
    const ivec3 voxel = low + cornerStep(corner);
    float share = cornerShare(part, corner);
    if (!(share > kLeastShare) || !isInGrid(voxel)) continue;
#if GATHER == GATHER_FACES && INTERPOLATION != INTERPOLATION_ALL
    share *= lights[corner].a;
#elif INTERPOLATION != INTERPOLATION_ALL
    if (!holdsSurface(cellAt(voxel))) continue;
#endif
#if INTERPOLATION == INTERPOLATION_VISIBLE
    if (lights[corner].a > 0.0) {
      // What is below the surface does not light it, whatever a ray meets.
      if (!isInFront(point, at, voxel, face)) continue;
      if (!isSurelySeen(near, voxel, face)) {
        doubtful |= 1u << corner;
        if ((seen >> corner & 1u) == 0u) continue;
      }
    }
#endif
    sum += share * vec4(lights[corner].rgb, 1.0);
  }
  return sum;
}

// The sum over the faces of their light by their weights; alpha: the weights.
void addFace(SurfacePoint point, int face, vec4 sum, inout vec4 result) {
  result += weightOf(point, face) * vec4(sum.rgb / sum.a, 1.0);
}

vec3 reflectedLight(vec4 result, vec3 albedo) {
#if GATHER == GATHER_FACES
  return result.a > 1e-4 ? albedo * result.rgb / (result.a * 3.14159265) : vec3(0.0);
#elif GATHER == GATHER_REFLECTED
  return max(result.rgb, 0.0) / 3.14159265;
#else
  return albedo * max(result.rgb, 0.0) / 3.14159265;
#endif
}
