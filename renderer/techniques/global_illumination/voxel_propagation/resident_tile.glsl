// SPDX-License-Identifier: BSD-3-Clause
// What both forms of resident steps share (resident_steps.h). Every invocation keeps one channel of one voxel, and groups stay on the
// GPU from the first step to the last. Lights of a group's own voxels and of those beside them are in shared memory. OpenGL does not
// promise that all groups of a dispatch make progress at a time: who uses this tries it first, and groups that wait too long say so
// and leave.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = TILE_X, local_size_y = TILE_Y, local_size_z = 3 * TILE_Z) in;  // z: channel and layer
#include "renderer/techniques/global_illumination/voxel_propagation/light_step.glsl"

layout(std430, binding = kStepSignalsBuffer) coherent volatile buffer Signals {
  uint stuck;      // 1: a group has waited in vain
  uint signals[];  // see propagate_resident.comp.glsl
};

uniform int steps;        // at least 1
uniform uint firstSignal;  // of step 0, counted on from dispatch to dispatch
uniform uint mostPolls;    // of a neighbour, after which a group is stuck

const ivec3 kTile = ivec3(TILE_X, TILE_Y, TILE_Z), kShell = kTile + 2;
const int kTileVoxels = TILE_X * TILE_Y * TILE_Z, kShellVoxels = (TILE_X + 2) * (TILE_Y + 2) * (TILE_Z + 2);
const int kShellLights = 3 * kShellVoxels;
// Of a group's voxels and those beside them; at the grid's own sides nothing is read of what is beyond.
shared LightKept lights[SHELLS * kShellLights];
shared uint lost;  // 1: an invocation of the group has waited in vain

const ivec3 kSideSizes = ivec3(TILE_Y * TILE_Z, TILE_X * TILE_Z, TILE_X * TILE_Y);  // voxels beyond a face of each axis
const int kBeyond = 2 * (kSideSizes.x + kSideSizes.y + kSideSizes.z), kInvocations = 3 * kTileVoxels;

int inShell(ivec3 local, int channel) {
  return local.x + 1 + kShell.x * (local.y + 1 + kShell.y * (local.z + 1)) + channel * kShellVoxels;
}

// The i-th of the voxels beyond the tile's faces.
ivec3 beyondTile(int i, out int side) {
  const int axis = i < 2 * kSideSizes.x ? 0 : i < 2 * (kSideSizes.x + kSideSizes.y) ? 1 : 2;
  i -= axis == 0 ? 0 : axis == 1 ? 2 * kSideSizes.x : 2 * (kSideSizes.x + kSideSizes.y);
  const bool low = i >= kSideSizes[axis];
  i -= low ? kSideSizes[axis] : 0;
  side = 2 * axis + (low ? 1 : 0);
  const int out_ = low ? -1 : kTile[axis], width = axis == 0 ? TILE_Y : TILE_X;
  const int u = i % width, v = i / width;
  return axis == 0 ? ivec3(out_, u, v) : axis == 1 ? ivec3(u, out_, v) : ivec3(u, v, out_);
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

// Between two looks at a neighbour. Mesa's software renderer ends loops after 65,535 rounds of an invocation in all, less than other
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

// Reads it, its walls, and the lights of its group's shell before the first step.
Resident residentVoxel() {
  const ivec3 tile = ivec3(gl_WorkGroupID), size = gridSize();
  const int channel = int(gl_LocalInvocationID.z) / TILE_Z, index = int(gl_LocalInvocationIndex), read = 3 * from * size.z;
  const ivec3 local = ivec3(gl_LocalInvocationID.xy, int(gl_LocalInvocationID.z) - channel * TILE_Z), voxel = kTile * tile + local;
  const bool there = isInGrid(voxel);
  Resident me = Resident(voxel, channel, inShell(local, channel), there,
                         there && (any(equal(local, ivec3(0))) || any(equal(local, kTile - 1))), 0u, vec4(0.0), vec4(0.0));
  if (index == 0) lost = 0u;
  for (int face = 0; face < 6; ++face) walls[face] = uvec3(0u);
  if (there) {
    me.cell = texelFetch(lightCells, voxel, 0).x;
    me.own = texelFetch(fields, ivec3(voxel.xy, read + channel * size.z + voxel.z), 0);
    me.lit = texelFetch(source, ivec3(voxel.xy, channel * size.z + voxel.z), 0);
    for (int face = 0; face < 6; ++face) {
      if (!besideSurface(me.cell, face) || holdsSurface(me.cell)) continue;
      const Wall wall = fetchWall(voxel + ivec3(faceDirection(face)), channel);
      walls[face] = uvec3(packHalf2x16(wall.surface.xy), packHalf2x16(wall.surface.zw), packHalf2x16(vec2(wall.albedo, 0.0)));
    }
  }
  lights[me.place] = keptOf(me.own);
  for (int i = index; i < 3 * kBeyond; i += kInvocations) {
    int side;
    const int of = i / kBeyond;
    const ivec3 beyond = beyondTile(i - of * kBeyond, side), at = kTile * tile + beyond;
    if (isInGrid(at)) lights[inShell(beyond, of)] = keptOf(texelFetch(fields, ivec3(at.xy, read + of * size.z + at.z), 0));
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

// Of a light in each half of a buffer of those at groups' sides.
int outsideIndex(ivec3 voxel, int channel) {
  return voxel.x + gridSize().x * (voxel.y + gridSize().y * (voxel.z + channel * gridSizeZ));
}
int halfOf(int s) { return (s & 1) * outsideIndex(ivec3(0), 3); }

void keepResident(Resident me) {
  if (me.there) imageStore(next, ivec3(me.voxel.xy, (3 * to + me.channel) * gridSizeZ + me.voxel.z), me.own);
}
