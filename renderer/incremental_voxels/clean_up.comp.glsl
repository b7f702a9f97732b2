// SPDX-License-Identifier: BSD-3-Clause
// Empties, in place, those voxels of which a depth image shows that there is nothing in them (Gaitatzes 2012, section 7.4.1). A
// group takes a brick: it lists the brick's occupied voxels, so that none of its invocations waits for empty ones.
#include "renderer/incremental_voxels/brick.glsl"
#ifdef FORGET  // what the grid did not hold before it moved by a number of voxels
uniform int shiftX, shiftY, shiftZ;
bool isDisproved(ivec3 voxel) { return !isInGrid(voxel + ivec3(shiftX, shiftY, shiftZ)); }
const int kDisproofStays = 0, kDisproofSurface = 1, kDisproofCleared = 2;
int disproofOfBrick(ivec3 first) { return kDisproofSurface; }
#else
#include "renderer/incremental_voxels/brick_disproof.glsl"
#endif

#ifdef LISTED_BRICKS
layout(std430, binding = kSampleSumsBuffer) readonly buffer Bricks { uint listedBricks[]; };
#endif

shared uint occupied[32 * kBrickWords];  // numbers of voxels
shared uint occupiedCount, clearedCount;

void main() {
  const uint lane = gl_LocalInvocationIndex;
  if (lane == 0u) occupiedCount = clearedCount = 0u;
  emptyNextCounts();
  barrier();
  if (groupNumber() >= brickCount) return;
#ifdef LISTED_BRICKS
  const ivec3 first = firstTexel(int(listedBricks[groupNumber()]));
#else
  const ivec3 first = firstTexel(groupNumber());
#endif
  const BrickWord word = loadWord(first);
  if (word.bits != 0u) {
    uint at = atomicAdd(occupiedCount, uint(bitCount(word.bits)));
    for (uint rest = word.bits; rest != 0u; rest &= rest - 1u) occupied[at++] = 32u * lane + uint(findLSB(rest));
  }
  barrier();
  if (occupiedCount == 0u) return;
  const int whole = disproofOfBrick(ivec3(32 * first.x, first.yz));
  for (uint i = lane; i < occupiedCount && whole != kDisproofStays; i += uint(kBrickLanes)) {
    const ivec3 stored = voxelIn(first, occupied[i]);
    if (whole != kDisproofCleared && !isDisproved(voxelStoredAt(stored))) continue;
    atomicAnd(words[occupied[i] / 32u], ~(1u << (occupied[i] % 32u)));
    atomicAdd(clearedCount, 1u);
    eraseAttributes(stored);
  }
  barrier();
  storeWord(word);
  if (lane == 0u) {
    atomicAdd(sampleCounts[turn].kept, occupiedCount - clearedCount);
    if (clearedCount > 0u) atomicAdd(sampleCounts[turn].cleared, clearedCount);
    if (whole == kDisproofSurface) atomicAdd(sampleCounts[turn].tested, 1u);
  }
}
