// SPDX-License-Identifier: BSD-3-Clause
// Empties, in place, those voxels of which a depth image shows that there is nothing in them (Gaitatzes 2012, section 7.4.1). A
// group takes a brick: it lists the brick's occupied voxels, so that none of its invocations waits for empty ones.
#include "renderer/incremental_voxels/incremental_bindings.h"
#include "renderer/voxels/volume.glsl"
#ifdef FORGET  // what the grid did not hold before it moved by a number of voxels
uniform int shiftX, shiftY, shiftZ;
bool isDisproved(ivec3 voxel) { return !isInGrid(voxel + ivec3(shiftX, shiftY, shiftZ)); }
const int kDisproofStays = 0, kDisproofSurface = 1, kDisproofCleared = 2;
int disproofOfBrick(ivec3 first) { return kDisproofSurface; }
#else
#include "renderer/incremental_voxels/brick_disproof.glsl"
#endif

layout(local_size_x = kBrickLanes) in;
layout(binding = kSampledBitsImage, r32ui) uniform uimage2DArray bitsImage;
layout(std430, binding = kSampleStateBuffer) buffer State {
  SampleCounts sampleCounts[2];
};
uniform int turn;
#ifdef LISTED_BRICKS
layout(std430, binding = kSampleSumsBuffer) readonly buffer Bricks { uint listedBricks[]; };
#endif
uniform int brickCount;
uniform int brickCountX, brickCountY;
#ifdef ATTRIBUTES
layout(binding = kSampledNormalImage, rgba16f) uniform writeonly image2DArray normalImage;
layout(binding = kSampledAlbedoImage, rgba16f) uniform writeonly image2DArray albedoImage;
layout(binding = kSampledLightImage, rgba16f) uniform writeonly image2DArray lightImage;
#endif

shared uint words[kBrickWords];
shared uint occupied[32 * kBrickWords];  // 32 times the word, plus the bit
shared uint occupiedCount, clearedCount;

void main() {
  const uint lane = gl_LocalInvocationIndex;
  const int group = int(gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y);
  if (lane == 0u) {
    occupiedCount = clearedCount = 0u;
    if (group == 0) sampleCounts[1 - turn] = SampleCounts(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
  }
  barrier();
  if (group >= brickCount) return;
#ifdef LISTED_BRICKS
  const int brick = int(listedBricks[group]);
#else
  const int brick = group;
#endif
  const ivec3 first = ivec3(1, kBrickSide, kBrickSide) *
                      ivec3(brick % brickCountX, brick / brickCountX % brickCountY, brick / (brickCountX * brickCountY));
  const ivec3 texel = first + ivec3(0, lane % uint(kBrickSide), lane / uint(kBrickSide));
  const bool isIn = lane < uint(kBrickWords) && texel.y < gridSizeY && texel.z < gridSizeZ;
  const uint word = isIn ? imageLoad(bitsImage, texel).x : 0u;
  if (isIn) words[lane] = word;
  if (word != 0u) {
    uint at = atomicAdd(occupiedCount, uint(bitCount(word)));
    for (uint rest = word; rest != 0u; rest &= rest - 1u) occupied[at++] = 32u * lane + uint(findLSB(rest));
  }
  barrier();
  if (occupiedCount == 0u) return;
  const int whole = disproofOfBrick(ivec3(32 * first.x, first.yz));
  for (uint i = lane; i < occupiedCount && whole != kDisproofStays; i += uint(kBrickLanes)) {
    const uint at = occupied[i] / 32u, bit = occupied[i] % 32u;
    const ivec3 voxel = ivec3(32 * first.x + int(bit), first.yz + ivec2(at % uint(kBrickSide), at / uint(kBrickSide)));
    if (whole != kDisproofCleared && !isDisproved(voxelStoredAt(voxel))) continue;
    atomicAnd(words[at], ~(1u << bit));
    atomicAdd(clearedCount, 1u);
#ifdef ATTRIBUTES
    imageStore(normalImage, voxel, vec4(0.0));
    imageStore(albedoImage, voxel, vec4(0.0));
    imageStore(lightImage, voxel, vec4(0.0));
#endif
  }
  barrier();
  if (isIn && words[lane] != word) imageStore(bitsImage, texel, uvec4(words[lane]));
  if (lane == 0u) {
    atomicAdd(sampleCounts[turn].kept, occupiedCount - clearedCount);
    if (clearedCount > 0u) atomicAdd(sampleCounts[turn].cleared, clearedCount);
    if (whole == kDisproofSurface) atomicAdd(sampleCounts[turn].tested, 1u);
  }
}
