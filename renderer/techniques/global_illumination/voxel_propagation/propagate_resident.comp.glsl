// SPDX-License-Identifier: BSD-3-Clause
// All steps in one dispatch, each as propagate.comp.glsl does it. Every invocation keeps one channel of one voxel, and groups stay on
// the GPU from the first step to the last. Lights of a group's own voxels and of those beside them are in shared memory. OpenGL does
// not promise that all groups of a dispatch make progress at a time: who uses this tries it first, and groups that wait too long say so
// and leave.
//
// Lights at groups' sides go through a buffer, in words of 16 bits of data and 16 of a tag, the step: who reads polls the words
// themselves until all tags are those of the step. Each word says by itself that it is new, so that nothing needs a signal or a memory
// barrier.
//
// Two halves of the buffer, of even and odd steps, suffice. A group writes its words of step s + 2 over those of s after a barrier that
// follows its reading of step s + 1 from each neighbour. A neighbour writes that after a barrier that follows its own reading of step s.
// So all that still had to read step s have done so. Tags are counted on from dispatch to dispatch and wrap; a word that is polled holds
// either its step's tag or that of the last step that wrote to its half, which is fewer than 2^16 steps ago.
//
// Between a barrier and the next an invocation waits for words that another of the same group, of its neighbour, has yet to send. GPUs
// run all invocations of a group at a time; a renderer that runs one after another up to the next barrier needs one in between, as
// where two shells of lights do not fit into shared memory.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = TILE_X, local_size_y = TILE_Y, local_size_z = 3 * TILE_Z) in;  // z: channel and layer
#include "renderer/techniques/global_illumination/voxel_propagation/light_step.glsl"

layout(std430, binding = kStepStuckBuffer) coherent volatile buffer Stuck {
  uint stuck;  // 1: a group has waited in vain
};
#ifdef FIELD_HALF
const int kTaggedWords = 1;  // of four each
#else
const int kTaggedWords = 2;
#endif
// Half, channel, layer, row, column.
layout(std430, binding = kStepLightsBuffer) coherent volatile buffer Lights { uvec4 outside[]; };

uniform int steps;      // at least 1
uniform uint firstTag;  // of step 0, counted on from dispatch to dispatch
uniform uint mostPolls;  // of a word, after which a group is stuck

const ivec3 kTile = ivec3(TILE_X, TILE_Y, TILE_Z), kShell = kTile + 2;
const int kTileVoxels = TILE_X * TILE_Y * TILE_Z, kShellVoxels = (TILE_X + 2) * (TILE_Y + 2) * (TILE_Z + 2);
const int kShellLights = 3 * kShellVoxels;
// Of a group's voxels and those beside them; at the grid's own sides nothing is read of what is beyond.
shared LightKept lights[SHELLS * kShellLights];
shared uint lost;  // 1: an invocation of the group has waited in vain

const ivec3 kSideSizes = ivec3(TILE_Y * TILE_Z, TILE_X * TILE_Z, TILE_X * TILE_Y);  // voxels beyond a face of each axis
const int kBeyond = 2 * (kSideSizes.x + kSideSizes.y + kSideSizes.z), kInvocations = 3 * kTileVoxels;
const int kRounds = (3 * kBeyond + kInvocations - 1) / kInvocations;  // in which a group reads all of those

int inShell(ivec3 local, int channel) {
  return local.x + 1 + kShell.x * (local.y + 1 + kShell.y * (local.z + 1)) + channel * kShellVoxels;
}

// The i-th of the voxels beyond the tile's faces.
ivec3 beyondTile(int i) {
  const int axis = i < 2 * kSideSizes.x ? 0 : i < 2 * (kSideSizes.x + kSideSizes.y) ? 1 : 2;
  i -= axis == 0 ? 0 : axis == 1 ? 2 * kSideSizes.x : 2 * (kSideSizes.x + kSideSizes.y);
  const bool low = i >= kSideSizes[axis];
  i -= low ? kSideSizes[axis] : 0;
  const int out_ = low ? -1 : kTile[axis], width = axis == 0 ? TILE_Y : TILE_X;
  const int u = i % width, v = i / width;
  return axis == 0 ? ivec3(out_, u, v) : axis == 1 ? ivec3(u, out_, v) : ivec3(u, v, out_);
}

// Of a light in each half of the buffer.
int outsideIndex(ivec3 voxel, int channel) {
  return voxel.x + gridSize().x * (voxel.y + gridSize().y * (voxel.z + channel * gridSizeZ));
}

// What an invocation reads of the lights beyond the tile in one round: from the buffer, or nothing, and to the shell.
struct Beyond {
  ivec3 voxel;
  int channel, outside, place;
};
const int kNothing = -1;
Beyond beyondOf(ivec3 tile, int i) {
  const int channel = i / kBeyond;
  const ivec3 local = beyondTile(i - channel * kBeyond), voxel = kTile * tile + local;
  const bool there = i < 3 * kBeyond && isInGrid(voxel);
  return Beyond(voxel, channel, there ? outsideIndex(voxel, channel) : kNothing, there ? inShell(local, channel) : 0);
}

// A voxel's walls, kept for all steps: halves hold what the volume does.
uvec3 walls[6];
Wall wallBeside(ivec3 voxel, int channel, int face) {
  const uvec3 wall = walls[face];
  return Wall(vec4(unpackHalf2x16(wall.x), unpackHalf2x16(wall.y)), unpackHalf2x16(wall.z).x);
}

// An invocation's voxel.
struct Resident {
  ivec3 voxel;
  int channel, place;  // place: of its light in a shell
  bool there, atSide;  // in the grid; beside another group's voxels, if there are any
  uint cell;
  vec4 own, lit;
};

vec4 lightBefore(ivec3 voxel, int channel) {
  return texelFetch(fields, ivec3(voxel.xy, 3 * from * gridSizeZ + channel * gridSizeZ + voxel.z), 0);
}

Resident residentVoxel(ivec3 tile) {
  const int channel = int(gl_LocalInvocationID.z) / TILE_Z;
  const ivec3 local = ivec3(gl_LocalInvocationID.xy, int(gl_LocalInvocationID.z) - channel * TILE_Z), voxel = kTile * tile + local;
  const bool there = isInGrid(voxel);
  Resident me = Resident(voxel, channel, inShell(local, channel), there,
                         there && (any(equal(local, ivec3(0))) || any(equal(local, kTile - 1))), 0u, vec4(0.0), vec4(0.0));
  for (int face = 0; face < 6; ++face) walls[face] = uvec3(0u);
  if (!there) return me;
  me.cell = texelFetch(lightCells, voxel, 0).x;
  me.own = lightBefore(voxel, channel);
  me.lit = texelFetch(source, ivec3(voxel.xy, channel * gridSizeZ + voxel.z), 0);
  for (int face = 0; face < 6; ++face) {
    if (!besideSurface(me.cell, face) || holdsSurface(me.cell)) continue;
    const Wall wall = fetchWall(voxel + ivec3(faceDirection(face)), channel);
    walls[face] = uvec3(packHalf2x16(wall.surface.xy), packHalf2x16(wall.surface.zw), packHalf2x16(vec2(wall.albedo, 0.0)));
  }
  return me;
}

// Its light after a step of those in the shell that begins at `first`.
vec4 afterResidentStep(Resident me, int first) {
  if (!holdsLight(me.cell)) return vec4(0.0);
  vec4 beside[6];
  for (int face = 0; face < 6; ++face) {
    const ivec3 towards = ivec3(faceDirection(face));
    beside[face] = lightKept(lights[first + me.place + towards.x + kShell.x * (towards.y + kShell.y * towards.z)]);
  }
  return afterStep(me.voxel, me.channel, me.cell, me.own, beside, me.lit);
}

// Between two looks at a word. Mesa's software renderer ends loops after 65,535 rounds of an invocation in all, less than other
// threads' turns may take: it waits longer for each.
void pause() {
#ifdef PATIENT
#define FOUR(x) x x x x
  FOUR(FOUR(FOUR(atomicOr(stuck, 0u);)))
#endif
}

// Of the group that has found nothing new.
void giveUp() {
  atomicOr(stuck, 1u);
  atomicOr(lost, 1u);
}

uvec4 tagged(uvec2 data, uint tag) { return uvec4(data.x & 0xffffu, data.x >> 16, data.y & 0xffffu, data.y >> 16) | tag << 16; }
bool bears(uvec4 words, uint tag) { return all(equal(words >> 16, uvec4(tag))); }
uvec2 dataOf(uvec4 words) { return (words.xz & 0xffffu) | words.yw << 16; }

void send(int index, LightKept kept, uint tag) {
#ifdef FIELD_HALF
  outside[index] = tagged(kept, tag);
#else
  const uvec4 bits = floatBitsToUint(kept);
  outside[kTaggedWords * index] = tagged(bits.xy, tag);
  outside[kTaggedWords * index + 1] = tagged(bits.zw, tag);
#endif
}

// Waits until all words are those of the step.
LightKept receive(int index, uint tag) {
  uvec4 words[kTaggedWords];
  bool done = false;
  for (uint poll = 0u; poll < mostPolls; ++poll) {
    done = true;
    for (int i = 0; i < kTaggedWords; ++i) {
      words[i] = outside[kTaggedWords * index + i];
      done = done && bears(words[i], tag);
    }
    if (done) break;
    if ((poll & 63u) == 63u && stuck != 0u) break;
    pause();
  }
  if (!done) giveUp();
#ifdef FIELD_HALF
  return dataOf(words[0]);
#else
  return uintBitsToFloat(uvec4(dataOf(words[0]), dataOf(words[1])));
#endif
}

void main() {
  const ivec3 tile = ivec3(gl_WorkGroupID);
  const int index = int(gl_LocalInvocationIndex);
  if (index == 0) lost = 0u;
  Resident me = residentVoxel(tile);
  lights[me.place] = keptOf(me.own);
  Beyond beyond[kRounds];
  for (int round = 0; round < kRounds; ++round) {
    beyond[round] = beyondOf(tile, index + round * kInvocations);
    if (beyond[round].outside != kNothing)
      lights[beyond[round].place] = keptOf(lightBefore(beyond[round].voxel, beyond[round].channel));
  }
  const int ownOutside = outsideIndex(me.voxel, me.channel), halfSize = outsideIndex(ivec3(0), 3);
  int shell = 0;
  barrier();
  for (int s = 1;; ++s) {
    me.own = afterResidentStep(me, shell);
    if (s == steps) break;
    const LightKept kept = keptOf(me.own);
    const uint tag = (firstTag + uint(s)) & 0xffffu;
    const int half_ = (s & 1) * halfSize;
    if (me.atSide) send(half_ + ownOutside, kept, tag);
#if SHELLS == 1
    barrier();  // all have read what is written over next, and sent theirs
#else
    shell = kShellLights - shell;
#endif
    lights[shell + me.place] = kept;
    for (int round = 0; round < kRounds; ++round)
      if (beyond[round].outside != kNothing) lights[shell + beyond[round].place] = receive(half_ + beyond[round].outside, tag);
    barrier();
    if (lost != 0u) return;
  }
  if (me.there) imageStore(next, ivec3(me.voxel.xy, (3 * to + me.channel) * gridSizeZ + me.voxel.z), me.own);
}
