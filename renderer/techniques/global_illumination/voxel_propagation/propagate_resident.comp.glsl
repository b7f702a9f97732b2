// SPDX-License-Identifier: BSD-3-Clause
// All steps in one dispatch, each as propagate.comp.glsl does it: every invocation keeps one channel of one voxel, and groups stay on
// the GPU from the first step to the last. Lights of a group's own voxels are in shared memory; those at its sides go through a buffer,
// and a group waits for the groups around it, no others, after each step. OpenGL does not promise that all groups of a dispatch make
// progress at a time: who uses this tries it first, and groups that wait too long say so and leave (see resident_steps.h).
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = TILE_X, local_size_y = TILE_Y, local_size_z = 3 * TILE_Z) in;  // z: channel and layer
#include "renderer/techniques/global_illumination/voxel_propagation/light_step.glsl"

layout(std430, binding = kStepSignalsBuffer) coherent volatile buffer Signals {
  uint stuck;      // 1: a group has waited in vain
  uint signals[];  // of group i at kSignalStride * i + 1: the step that it has done, counted on from dispatch to dispatch
};
// Of two steps in turn, as the groups around may still read the last: half, channel, layer, row, column.
layout(std430, binding = kStepLightsBuffer) coherent buffer Lights { LightKept outside[]; };

uniform int steps;        // at least 1
uniform uint firstSignal;  // of step 0
uniform uint mostPolls;    // of a neighbour's signal, after which a group is stuck

const ivec3 kTile = ivec3(TILE_X, TILE_Y, TILE_Z), kShell = kTile + 2;
const int kTileVoxels = TILE_X * TILE_Y * TILE_Z, kShellVoxels = (TILE_X + 2) * (TILE_Y + 2) * (TILE_Z + 2);
// Of a group's voxels and those beside them; at the grid's own sides nothing is read of what is beyond.
shared LightKept lights[3 * kShellVoxels];
shared uint lost;

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

uint groupAt(ivec3 tile) {
  const ivec3 tiles = ivec3(gl_NumWorkGroups);
  return uint(tile.x + tiles.x * (tile.y + tiles.y * tile.z));
}

// Waits for the group beyond one of the six sides.
void awaitNeighbour(ivec3 tile, int side, uint signal) {
  const uint word = kSignalStride * groupAt(tile + ivec3(faceDirection(side))) + 1u;
  bool done = false;
  for (uint poll = 0u; poll < mostPolls && !done; ++poll) {
    done = int(signals[word] - signal) >= 0;
    if (!done && (poll & 63u) == 63u && stuck != 0u) break;
  }
  if (!done) {
    atomicOr(stuck, 1u);
    atomicOr(lost, 1u);
  }
}

void main() {
  const ivec3 tile = ivec3(gl_WorkGroupID), size = gridSize();
  const int channel = int(gl_LocalInvocationID.z) / TILE_Z, index = int(gl_LocalInvocationIndex);
  const ivec3 local = ivec3(gl_LocalInvocationID.xy, int(gl_LocalInvocationID.z) - channel * TILE_Z), voxel = kTile * tile + local;
  const int read = 3 * from * size.z, perHalf = 3 * size.x * size.y * size.z, place = inShell(local, channel);
  const int ownOutside = voxel.x + size.x * (voxel.y + size.y * (voxel.z + channel * size.z));
  const bool there = isInGrid(voxel);
  const bool atSide = there && (any(equal(local, ivec3(0))) || any(equal(local, kTile - 1)));
  if (index == 0) lost = 0u;
  uint cell = 0u;
  vec4 own = vec4(0.0), lit = vec4(0.0);
  for (int face = 0; face < 6; ++face) walls[face] = uvec3(0u);
  if (there) {
    cell = texelFetch(lightCells, voxel, 0).x;
    own = texelFetch(fields, ivec3(voxel.xy, read + channel * size.z + voxel.z), 0);
    lit = texelFetch(source, ivec3(voxel.xy, channel * size.z + voxel.z), 0);
    for (int face = 0; face < 6; ++face) {
      if (!besideSurface(cell, face) || holdsSurface(cell)) continue;
      const Wall wall = fetchWall(voxel + ivec3(faceDirection(face)), channel);
      walls[face] = uvec3(packHalf2x16(wall.surface.xy), packHalf2x16(wall.surface.zw), packHalf2x16(vec2(wall.albedo, 0.0)));
    }
  }
  lights[place] = keptOf(own);
  for (int i = index; i < 3 * kBeyond; i += kInvocations) {
    int side;
    const int of = i / kBeyond;
    const ivec3 beyond = beyondTile(i - of * kBeyond, side), at = kTile * tile + beyond;
    if (isInGrid(at)) lights[inShell(beyond, of)] = keptOf(texelFetch(fields, ivec3(at.xy, read + of * size.z + at.z), 0));
  }
  barrier();
  for (int s = 1;; ++s) {
    if (holdsLight(cell)) {
      vec4 beside[6];
      for (int face = 0; face < 6; ++face) {
        const ivec3 towards = ivec3(faceDirection(face));
        beside[face] = lightKept(lights[place + towards.x + kShell.x * (towards.y + kShell.y * towards.z)]);
      }
      own = afterStep(voxel, channel, cell, own, beside, lit);
    } else {
      own = vec4(0.0);
    }
    if (s == steps) break;
    const LightKept kept = keptOf(own);
    const int half_ = (s & 1) * perHalf;
    if (atSide) {
      outside[half_ + ownOutside] = kept;
      memoryBarrierBuffer();
    }
    barrier();
    const uint signal = firstSignal + uint(s);
    if (index == 0) signals[kSignalStride * groupAt(tile) + 1u] = signal;
    lights[place] = kept;
    for (int i = index; i < 3 * kBeyond; i += kInvocations) {
      int side;
      const int of = i / kBeyond;
      const ivec3 beyond = beyondTile(i - of * kBeyond, side), at = kTile * tile + beyond;
      if (!isInGrid(at)) continue;
      awaitNeighbour(tile, side, signal);
      memoryBarrierBuffer();
      lights[inShell(beyond, of)] = outside[half_ + at.x + size.x * (at.y + size.y * (at.z + of * size.z))];
    }
    barrier();
    if (lost != 0u) return;
  }
  if (there) imageStore(next, ivec3(voxel.xy, (3 * to + channel) * size.z + voxel.z), own);
}
