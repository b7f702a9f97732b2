// SPDX-License-Identifier: BSD-3-Clause
// Light of the listed pixels that see no lit voxel around them at some face, as in crevices lower than a voxel: there that of the nearest
// voxel that they see of those around their own; and if there is none at any face, of those farther around, in ever wider cubes. Also
// light of pixels whose rays did not fit into the list.
#include "renderer/techniques/global_illumination/indirect_point.glsl"

layout(local_size_x = kAskedGroup) in;
layout(binding = kIndirectPictureImage, rgba32f) uniform image2D picture;
#include "renderer/techniques/global_illumination/voxel_propagation/gather_light.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/asked_lists.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/seen_voxel.glsl"

uniform int widest;  // voxels around that are looked at

// Voxels around a point's own are looked at in blocks, whose cells are fetched at once: what is fetched one after another is waited for
// one after another. All 27 within one voxel are a block; within two each layer of 25; and beyond each row.
int blocksWithin(int reach) { return reach == 1 ? 1 : reach == 2 ? 5 : (2 * reach + 1) * (2 * reach + 1); }
ivec3 blockStep(int reach, int block, int i) {
  if (reach == 1) return ivec3(i % 3, i / 3 % 3, i / 9) - 1;
  if (reach == 2) return ivec3(i % 5, i / 5, block) - 2;
  const int side = 2 * reach + 1;
  return ivec3(i, block % side, block / side) - reach;
}
bool isLitAround(SurfacePoint point, vec3 at, ivec3 voxel, int face) {
  return isInFront(point, at, voxel, face) && isLit(cellAt(voxel), face);
}
// Of a block, those lit at a face that are not below the surface, a bit each; without those within `reach - 1`, looked at before.
uint litVoxels(SurfacePoint point, vec3 at, ivec3 own, int face, int reach, int block) {
  uint lit = 0u;
  if (reach == 1) {
    for (int i = 0; i < 27; ++i)
      if (isLitAround(point, at, own + blockStep(1, 0, i), face)) lit |= 1u << i;
  } else if (reach == 2) {
    for (int i = 0; i < 25; ++i) {
      const ivec3 away = blockStep(2, block, i);
      if ((abs(block - 2) == 2 || max(abs(away.x), abs(away.y)) == 2) && isLitAround(point, at, own + away, face)) lit |= 1u << i;
    }
  } else {
    const ivec3 first = blockStep(reach, block, 0);
    const bool inside = max(abs(first.y), abs(first.z)) < reach;
    for (int i = 0; i < 9; ++i)
      if (i <= 2 * reach && !(inside && i != 0 && i != 2 * reach) && isLitAround(point, at, own + first + ivec3(i, 0, 0), face))
        lit |= 1u << i;
  }
  return lit;
}

// The nearest of those of a block.
int nearestOf(uint lit, vec3 at, ivec3 own, int reach, int block) {
  int nearest = -1;
  float least = 1e30;
  for (; lit != 0u; lit &= lit - 1u) {
    const int i = findLSB(lit);
    const vec3 away = vec3(own + blockStep(reach, block, i)) - at;
    if (dot(away, away) >= least) continue;
    least = dot(away, away);
    nearest = i;
  }
  return nearest;
}

// One place in the shader traces rays, as each takes many registers.
vec4 searchedAtFace(SurfacePoint point, vec3 at, int face, bool traced, uint seen, bool wide) {
  const ivec3 low = ivec3(floor(at)), own = ivec3(floor(at + 0.5));
  uint left = 0u;
  vec4 sum = vec4(0.0);
  if (!wide) sum = lightAtFace(point, at, face, seen, left);
  if (traced) left = 0u;
  bool around = false;
  float nearest = 1e30;
  int reach = wide ? 2 : 1, block = -1;
  ivec3 best = own;
  for (;;) {
    if (left == 0u) {
      if (!around && sum.a > kLeastKnown) break;
      around = true;
      ++block;
      if (block >= blocksWithin(reach)) {
        if (!wide || nearest < 1e29 || reach >= widest) break;
        ++reach;
        block = 0;
      }
      left = litVoxels(point, at, own, face, reach, block);
      continue;
    }
    const int i = around ? nearestOf(left, at, own, reach, block) : findLSB(left);
    const ivec3 voxel = around ? own + blockStep(reach, block, i) : low + cornerStep(i);
    const vec3 away = vec3(voxel) - at;
    left &= ~(1u << i);
    if (around && dot(away, away) >= nearest) {
      left = 0u;  // the others of the block are farther still
      continue;
    }
    if (!seesVoxel(point, voxel + faceStep(face))) continue;
    if (around) {
      nearest = dot(away, away);
      best = voxel;
      left = 0u;
    } else {
      sum += cornerShare(at - vec3(low), i) * vec4(lightOf(voxel, face).rgb, 1.0);
    }
  }
  return nearest < 1e29 ? vec4(lightOf(best, face).rgb, 1.0) : sum;
}

void main() {
  const uint place = listedPlace();
  if (place >= asked.searches.listed) return;
  const uint entry = askedPixels[searchPlace(place)], number = entry & ~kNotTraced;
  const ivec2 pixel = pixelOf(number);
  SurfacePoint point;
  if (!pixelSees(pixel, point)) return;
  const vec3 at = toVoxels(point.position) - 0.5;
  const uvec2 seen = seenCorners[number];
  vec4 result = vec4(0.0);
  bool wide = false, found = false;
  const uint faces = weightedFaces(point);
  uint left = faces;
  // Not unrolled, so that rays stay in one place.
  for (;;) {
    if (left == 0u) {
      if (wide || found || widest < 2) break;
      wide = true;
      left = faces;
      continue;
    }
    const int face = findLSB(left);
    left &= left - 1u;
    const vec4 sum = searchedAtFace(point, at, face, (entry & kNotTraced) == 0u, seenAtFace(seen, face), wide);
    if (!(sum.a > kLeastKnown)) continue;
    addFace(point, face, sum, result);
    found = true;
  }
  const vec3 colour = imageLoad(picture, pixel).rgb + reflectedLight(result, reflectance(point));
  imageStore(picture, pixel, vec4(unlessCutShort(colour), 1.0));
}
