// SPDX-License-Identifier: BSD-3-Clause
// A brick of voxels where they are stored, as dispatchBricks() gives one to each group: its words of bits are the group's.
#include "renderer/incremental_voxels/sampled_volume.glsl"
#include "renderer/voxels/volume.glsl"

layout(local_size_x = kBrickLanes) in;
uniform int brickCount, brickCountX, brickCountY;

shared uint words[kBrickWords];

int groupNumber() { return int(gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y); }

// One invocation of all: the next step counts from 0.
void emptyNextCounts() {
  if (groupNumber() == 0 && gl_LocalInvocationIndex == 0u) sampleCounts[1 - turn] = SampleCounts(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
}

// Texel of a brick's first word.
ivec3 firstTexel(int brick) {
  return ivec3(1, kBrickSide, kBrickSide) *
         ivec3(brick % brickCountX, brick / brickCountX % brickCountY, brick / (brickCountX * brickCountY));
}

// An invocation's word of a brick, if it has one.
struct BrickWord {
  ivec3 texel;
  bool isIn;
  uint bits;
};
BrickWord loadWord(ivec3 first) {
  const uint lane = gl_LocalInvocationIndex;
  BrickWord word;
  word.texel = first + ivec3(0, lane % uint(kBrickSide), lane / uint(kBrickSide));
  word.isIn = lane < uint(kBrickWords) && word.texel.y < gridSizeY && word.texel.z < gridSizeZ;
  word.bits = word.isIn ? imageLoad(bitsImage, word.texel).x : 0u;
  if (lane < uint(kBrickWords)) words[lane] = word.bits;
  return word;
}
void storeWord(BrickWord word) {
  if (word.isIn && words[gl_LocalInvocationIndex] != word.bits) imageStore(bitsImage, word.texel, uvec4(words[gl_LocalInvocationIndex]));
}

// Where voxel `number`, 32 times the word plus the bit, is stored.
ivec3 voxelIn(ivec3 first, uint number) {
  const uint at = number / 32u;
  return ivec3(32 * first.x + int(number % 32u), first.yz + ivec2(at % uint(kBrickSide), at / uint(kBrickSide)));
}
