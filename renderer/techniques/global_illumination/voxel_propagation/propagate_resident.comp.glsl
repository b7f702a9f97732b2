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

const ivec3 kTile = ivec3(TILE_X, TILE_Y, TILE_Z);
const int kTileVoxels = TILE_X * TILE_Y * TILE_Z;
shared LightKept lights[2][3 * kTileVoxels];  // of two steps in turn
shared uint lost;

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
  const ivec3 beyond = tile + ivec3(faceDirection(side));
  if (any(lessThan(beyond, ivec3(0))) || any(greaterThanEqual(beyond, ivec3(gl_NumWorkGroups)))) return;
  const uint word = kSignalStride * groupAt(beyond) + 1u;
  bool done = false;
  for (uint poll = 0u; poll < mostPolls && !done; ++poll) {
    done = int(atomicOr(signals[word], 0u) - signal) >= 0;
    if (!done && (poll & 63u) == 63u && stuck != 0u) break;
  }
  if (!done) {
    atomicOr(stuck, 1u);
    atomicOr(lost, 1u);
  }
}

void main() {
  const ivec3 tile = ivec3(gl_WorkGroupID);
  const int channel = int(gl_LocalInvocationID.z) / TILE_Z, index = int(gl_LocalInvocationIndex);
  const ivec3 local = ivec3(gl_LocalInvocationID.xy, int(gl_LocalInvocationID.z) - channel * TILE_Z), size = gridSize();
  const ivec3 voxel = kTile * tile + local, strides = ivec3(1, size.x, size.x * size.y), localStrides = ivec3(1, TILE_X, TILE_X * TILE_Y);
  const int perHalf = 3 * size.x * size.y * size.z;
  const int place = voxel.x + size.x * (voxel.y + size.y * (voxel.z + channel * size.z));
  const int read = (3 * from + channel) * gridSizeZ;
  const bool there = isInGrid(voxel);
  const bool atSide = any(equal(local, ivec3(0))) || any(equal(local, kTile - 1));
  if (index == 0) lost = 0u;
  uint cell = 0u;
  vec4 own = vec4(0.0), lit = vec4(0.0);
  for (int face = 0; face < 6; ++face) walls[face] = uvec3(0u);
  if (there) {
    cell = texelFetch(lightCells, voxel, 0).x;
    own = texelFetch(fields, ivec3(voxel.xy, read + voxel.z), 0);
    lit = texelFetch(source, ivec3(voxel.xy, channel * gridSizeZ + voxel.z), 0);
    for (int face = 0; face < 6; ++face) {
      if (!besideSurface(cell, face) || holdsSurface(cell)) continue;
      const Wall wall = fetchWall(voxel + ivec3(faceDirection(face)), channel);
      walls[face] = uvec3(packHalf2x16(wall.surface.xy), packHalf2x16(wall.surface.zw), packHalf2x16(vec2(wall.albedo, 0.0)));
    }
  }
  lights[0][index] = keptOf(own);
  barrier();
  for (int s = 0;; ++s) {
    if (holdsLight(cell)) {
      vec4 beside[6];
      for (int face = 0; face < 6; ++face) {
        const int axis = face >> 1, way = (face & 1) == 0 ? 1 : -1;
        const int inTile = local[axis] + way, inGrid = voxel[axis] + way;
        if (inTile >= 0 && inTile < kTile[axis]) {
          beside[face] = lightKept(lights[s & 1][index + way * localStrides[axis]]);
        } else if (inGrid < 0 || inGrid >= size[axis]) {
          beside[face] = own;
        } else if (s == 0) {
          const ivec3 beyond = voxel + ivec3(faceDirection(face));
          beside[face] = texelFetch(fields, ivec3(beyond.xy, read + beyond.z), 0);
        } else {
          beside[face] = lightKept(outside[(s & 1) * perHalf + place + way * strides[axis]]);
        }
      }
      own = afterStep(voxel, channel, cell, own, beside, lit);
    } else {
      own = vec4(0.0);
    }
    if (s + 1 == steps) break;
    const LightKept kept = keptOf(own);
    lights[s + 1 & 1][index] = kept;
    if (there && atSide) outside[(s + 1 & 1) * perHalf + place] = kept;
    memoryBarrierBuffer();
    barrier();
    const uint signal = firstSignal + uint(s) + 1u;
    if (index == 0) signals[kSignalStride * groupAt(tile) + 1u] = signal;
    if (index < 6) {
      awaitNeighbour(tile, index, signal);
      memoryBarrierBuffer();
    }
    barrier();
    if (lost != 0u) return;
  }
  if (there) imageStore(next, ivec3(voxel.xy, (3 * to + channel) * gridSizeZ + voxel.z), own);
}
