// SPDX-License-Identifier: BSD-3-Clause
// All steps in one dispatch, each as propagate.comp.glsl does it. Lights at groups' sides go through a buffer, and a group waits for the
// signals of the groups around it, no others, after each step. The signal of group i, at kSignalStride * i + 1, is the step that it has
// done.
#include "renderer/techniques/global_illumination/voxel_propagation/resident_tile.glsl"

// Of two steps in turn, as the groups around may still read the last: half, channel, layer, row, column.
layout(std430, binding = kStepLightsBuffer) coherent buffer Lights { LightKept outside[]; };

uint groupAt(ivec3 tile) {
  const ivec3 tiles = ivec3(gl_NumWorkGroups);
  return uint(tile.x + tiles.x * (tile.y + tiles.y * tile.z));
}

// Waits for the group beyond one of the six sides.
void awaitNeighbour(ivec3 tile, int side, uint signal) {
  const uint word = kSignalStride * groupAt(tile + ivec3(faceDirection(side))) + 1u;
  bool done = false;
  for (uint poll = 0u; poll < mostPolls; ++poll) {
    done = int(signals[word] - signal) >= 0;
    if (done) break;
    if ((poll & 63u) == 63u && stuck != 0u) break;
    pause();
  }
  if (!done) giveUp();
}

void main() {
  const ivec3 tile = ivec3(gl_WorkGroupID);
  const int index = int(gl_LocalInvocationIndex);
  Resident me = residentVoxel();
  const int ownOutside = outsideIndex(me.voxel, me.channel);
  barrier();
  for (int s = 1;; ++s) {
    me.own = afterResidentStep(me, 0);
    if (s == steps) break;
    const LightKept kept = keptOf(me.own);
    if (me.atSide) {
      outside[halfOf(s) + ownOutside] = kept;
      // OpenGL's memory barriers wait for what their invocation has written until all others see it, so that none is needed between
      // the group's barrier and the signal, which is written when all are through theirs.
      memoryBarrierBuffer();
    }
    barrier();
    const uint signal = firstSignal + uint(s);
    if (index == 0) signals[kSignalStride * groupAt(tile) + 1u] = signal;
    lights[me.place] = kept;
    for (int i = index; i < 3 * kBeyond; i += kInvocations) {
      int side;
      const int of = i / kBeyond;
      const ivec3 beyond = beyondTile(i - of * kBeyond, side), at = kTile * tile + beyond;
      if (!isInGrid(at)) continue;
      awaitNeighbour(tile, side, signal);
      memoryBarrierBuffer();
      lights[inShell(beyond, of)] = outside[halfOf(s) + outsideIndex(at, of)];
    }
    barrier();
    if (lost != 0u) return;
  }
  keepResident(me);
}
