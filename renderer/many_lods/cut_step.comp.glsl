// SPDX-License-Identifier: BSD-3-Clause
// A whole step in one dispatch: groups say what becomes of their entries and take room for it where the list goes on, in the order in
// which they come. The last one has the next step dispatched. RULE, LINKED: cut_events.glsl. SPLITS_LATER: what has to be split is left over, so that a step over a long
// list of which little changes is a light one.
#include "renderer/many_lods/many_lods_bindings.h"

layout(local_size_x = kCutGroup) in;
layout(std430, binding = kCutNodesBuffer) readonly buffer Nodes { vec4 nodes[]; };
layout(std430, binding = kCutViewsBuffer) readonly buffer Views { CutView views[]; };
#include "renderer/many_lods/cut_events.glsl"
#include "renderer/many_lods/cut_splits.glsl"

uniform uint lastStep;    // steps end here even if entries are left over
uniform uint splitsEach;  // of a node by one level of the tree; rooms are used up in these

#ifdef SPLITS_LATER
const int kRows = kKeepRows;
#else
const int kRows = kSplitRows;
#endif
const int kTile = kCutGroup * kRows;

shared uvec2 line[kCutGroup];
shared uint finishedBase, leftBase, granted;

// Kept and split, 16 bits each, and left over.
uvec2 packedSums(uint code, uint node) {
#ifdef SPLITS_LATER
  return uvec2(code == kCodeDropped ? 0u : 1u, code == kCodeOpen ? 1u : 0u);
#endif
  return uvec2((code == kCodeDropped ? 0u : 1u) | splitsOf(code) << 16u, leftOver(code, node, splitLevels));
}

void finishStep(uint count, uint finished, uint budget) {
  const uint made = atomicAdd(steps[step_].made, 0u), left = atomicAdd(steps[step_].left, 0u);
  control.splits += min(atomicAdd(steps[step_].asked, 0u), budget);
  control.steps = step_ + 1u;
  control.count = finished + made;
  control.readAt = steps[step_].finishedAt;
  control.drawX = groupsFor(control.count, uint(kSplatGroup));
  control.drawY = control.drawZ = 1u;
  if (step_ >= lastStep || left == 0u) return;
  const uint next = step_ + 1u;
  steps[next].readAt = steps[step_].leftAt;
  steps[next].leftAt = steps[step_].readAt;
  steps[next].finishedAt = steps[step_].finishedAt;
  steps[next].finished = finished + made;
  steps[next].count = left;
  steps[next].classifyX = groupsFor(left, uint(kCutGroup * kSplitRows));
  steps[next].classifyY = steps[next].classifyZ = 1u;
}

void main() {
  const uint me = gl_LocalInvocationIndex;
  const uint count = steps[step_].count, at = steps[step_].readAt;
  const uint finished = steps[step_].finished, finishedAt = steps[step_].finishedAt + finished, leftAt = steps[step_].leftAt;
  // As if nothing were dropped: what is dropped is known when all is done.
  uint budget = capacity - finished - count;
  budget -= budget % splitsEach;
  for (uint tile = gl_WorkGroupID.x; tile * uint(kTile) < count; tile += gl_NumWorkGroups.x) {
    // Entries of an invocation follow each other, so that a tile keeps its order.
    const uint first = tile * uint(kTile) + me * uint(kRows);
    uint codes[kRows];
    uvec2 own = uvec2(0u);
    for (int row = 0; row < kRows; ++row) {
      const uint index = first + uint(row);
      codes[row] = kCodeDropped;
      if (index >= count) continue;
      codes[row] = codeOf(at, index, count);
      own += packedSums(codes[row], list[at + index].x);
    }
    barrier();
    line[me] = own;
    barrier();
    for (uint distance_ = 1u; distance_ < uint(kCutGroup); distance_ *= 2u) {
      uvec2 upTo = line[me];
      if (me >= distance_) upTo += line[me - distance_];
      barrier();
      line[me] = upTo;
      barrier();
    }
    if (me == uint(kCutGroup) - 1u) {
      const uint kept = line[me].x & 0xffffu, asked = line[me].x >> 16u;
      uint here = asked;
      if (asked > 0u) {
        const uint before = atomicAdd(steps[step_].asked, asked);
        here = min(asked, budget - min(before, budget));
        if (here < asked) atomicAdd(control.refused, asked - here);
      }
      granted = here;
      const uint left = here < asked ? 0u : line[me].y;
      finishedBase = atomicAdd(steps[step_].made, kept + here - left);
      leftBase = left > 0u ? atomicAdd(steps[step_].left, left) : 0u;
    }
    barrier();
    // Without room for all, what there is room for is made, and nothing is left over.
    const bool full = granted < line[kCutGroup - 1].x >> 16u;
    const uvec2 before = line[me] - own;
    uvec3 so = uvec3(before.x & 0xffffu, before.x >> 16u, before.y);
    for (int row = 0; row < kRows; ++row) {
      const uint code = codes[row];
      if (code == kCodeDropped) continue;
      const uvec2 entry = list[at + first + uint(row)];
      const uint view = entry.y & ~kEntryDone;
#ifdef SPLITS_LATER
      const bool isOpen = code == kCodeOpen;
      const uint place = isOpen ? leftAt + leftBase + so.z : finishedAt + finishedBase + so.x - so.z;
      list[place] = isOpen ? uvec2(entry.x, view) : uvec2(ancestorOf(entry.x, code >> kCodeClimbShift), view);
#ifdef MARGINS
      margins[place] = isOpen ? 0u : margins[at + first + uint(row)];
#endif
      so += uvec3(1u, 0u, isOpen ? 1u : 0u);
      continue;
#else
      const uint splits = (code & kCodeSplit) != 0u ? code : 0u;
      uint to = finishedAt + finishedBase + so.x + min(so.y, granted) - (full ? 0u : so.z), leftTo = leftAt + leftBase + so.z;
      const uint room = granted - min(granted, so.y);
      so += uvec3(1u, bitCount(splits), leftOver(code, entry.x, splitLevels));
      if (splits == 0u) {
        list[to] = uvec2(ancestorOf(entry.x, code >> kCodeClimbShift), view);
#ifdef MARGINS
        margins[to] = margins[at + first + uint(row)];
#endif
        continue;
      }
      const uint kept = within(splits, room);
      const bool goesOn = !full && mayGoOn(entry.x, splitLevels);
      uint place = 1u;
      while (place != 0u) {
        if (place < 1u << splitLevels && (kept >> (place - 1u) & 1u) != 0u) {
          place *= 2u;
          continue;
        }
        const uvec2 made = uvec2(nodeBelow(entry.x, place), view);
        const uint there = goesOn && place >= 1u << splitLevels ? leftTo++ : to++;
        list[there] = made;
#ifdef MARGINS
        margins[there] = 0u;
#endif
        while ((place & 1u) != 0u) place >>= 1u;
        if (place != 0u) ++place;
      }
#endif
    }
    barrier();
  }
#ifdef COUNTING
  addCounts();
#endif
  memoryBarrierBuffer();
  barrier();
  if (me > 0u) return;
  if (atomicAdd(steps[step_].groupsDone, 1u) == gl_NumWorkGroups.x - 1u) finishStep(count, finished, budget);
}
