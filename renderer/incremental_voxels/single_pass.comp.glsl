// SPDX-License-Identifier: BSD-3-Clause
// Clean-up and injection in one (Gaitatzes 2012, section 7.4.3): a voxel whose middle lies within the bias of the surface that a
// view sees there is filled with what that pixel shows; one before it is emptied; one behind it stays. A brick a group, which
// first finds what becomes of each voxel and then shares those among its invocations that take attributes.
#include "renderer/frame/frame_bindings.h"
#include "renderer/incremental_voxels/brick.glsl"
#include "renderer/incremental_voxels/brick_disproof.glsl"
#ifdef ATTRIBUTES
#include "renderer/incremental_voxels/seen_surface.glsl"
#endif

shared uint keptCount, clearedCount, addedCount;
#ifdef ATTRIBUTES
shared uint seenCount;
shared uint seen[32 * kBrickWords];  // voxel of the brick, and 2^16 times the view that sees it
#endif

#ifdef ATTRIBUTES
// `stored`: where the voxel is stored.
void update(ivec3 stored, int view) {
  const ivec3 voxel = voxelStoredAt(stored);
  const vec2 place = viewPlace(view, toView(view, vec3(voxel) + 0.5));
  const ivec2 pixel = ivec2(place);
  const vec3 at = (voxelsFromView[view] * vec4(viewNear[view] / depthAt(view, pixel) * viewRay(view, pixel), 1.0)).xyz;
  const SeenSurface surface = surfaceOf(view, pixel, at);
  storeAttributes(stored, surface.normal, surface.albedo, surface.light);
}
#endif

// What a voxel becomes; `by`: the view that sees it, or -1.
bool isFilled(ivec3 voxel, bool before, out int by) {
  by = -1;
  for (int view = 0; view < USED_VIEWS; ++view) {
    const int found = disproofByView(view, voxel);
    if (found == kDisproofCleared) {
      by = -1;
      return false;
    }
    if (found == kDisproofSurface && by < 0) by = view;
  }
  return before || by >= 0;
}

void main() {
  const uint lane = gl_LocalInvocationIndex;
  if (lane == 0u) {
    keptCount = clearedCount = addedCount = 0u;
#ifdef ATTRIBUTES
    seenCount = 0u;
#endif
  }
  emptyNextCounts();
  barrier();
  if (groupNumber() >= brickCount) return;
  const ivec3 first = firstTexel(groupNumber());
  const BrickWord word = loadWord(first);
  if (word.bits != 0u) atomicAdd(keptCount, uint(bitCount(word.bits)));
  barrier();
  const int whole = disproofOfBrick(ivec3(32 * first.x, first.yz));
  const uint before = keptCount;
  barrier();
  // A brick without surface is done, unless something in it has to go.
  if (whole == kDisproofStays || (whole == kDisproofCleared && before == 0u)) {
    if (lane == 0u && before > 0u) atomicAdd(sampleCounts[turn].kept, before);
    return;
  }
  for (uint i = lane; i < 32u * uint(kBrickWords); i += uint(kBrickLanes)) {
    const ivec3 voxel = voxelIn(first, i);
    if (!isInGrid(voxel)) continue;
    const uint at = i / 32u, bit = i % 32u;
    int by = -1;
    const bool was = (words[at] >> bit & 1u) != 0u, is = whole != kDisproofCleared && isFilled(voxelStoredAt(voxel), was, by);
#ifdef ATTRIBUTES
    if (by >= 0) seen[atomicAdd(seenCount, 1u)] = i | uint(by) << 16;
#endif
    if (was && !is) {
      eraseAttributes(voxel);
      atomicAnd(words[at], ~(1u << bit));
      atomicAdd(clearedCount, 1u);
    }
    if (!was && is) {
      atomicOr(words[at], 1u << bit);
      atomicAdd(addedCount, 1u);
    }
  }
  barrier();
#ifdef ATTRIBUTES
  for (uint i = lane; i < seenCount; i += uint(kBrickLanes)) update(voxelIn(first, seen[i] & 0xffffu), int(seen[i] >> 16));
#endif
  storeWord(word);
  if (lane == 0u) {
    if (before > clearedCount) atomicAdd(sampleCounts[turn].kept, before - clearedCount);
    if (clearedCount > 0u) atomicAdd(sampleCounts[turn].cleared, clearedCount);
    if (addedCount > 0u) atomicAdd(sampleCounts[turn].added, addedCount);
    if (whole == kDisproofSurface) atomicAdd(sampleCounts[turn].tested, 1u);
  }
}
