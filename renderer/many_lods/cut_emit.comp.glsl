// SPDX-License-Identifier: BSD-3-Clause
// Writes what a step makes of the list, in the same order. ORDERED: all together; else what is finished behind what earlier steps have
// finished, and what the next step has to look at apart. LINKED: tree_links.glsl.
#include "renderer/many_lods/cut_lists.glsl"
#include "renderer/many_lods/tree_links.glsl"

layout(local_size_x = kCutGroup) in;
layout(std430, binding = kCutCodesBuffer) readonly buffer Codes { uvec4 codes[]; };
layout(std430, binding = kCutTilesBuffer) readonly buffer Tiles { uvec4 tiles[]; };

uniform uint splitLevels;

shared uvec3 line[kCutGroup];

#include "renderer/many_lods/cut_splits.glsl"

void main() {
  const uint me = gl_LocalInvocationIndex;
  const CutStep now = steps[step_];
  const bool full = now.full != 0u;
  for (uint tile = gl_WorkGroupID.x; tile * uint(kCutTile) < now.count; tile += gl_NumWorkGroups.x) {
    const uint first = tile * uint(kCutTile) + me * uint(kCutRows);
    const uvec4 found = codes[first / uint(kCutRows)];
    uvec3 own = uvec3(0u);
    for (uint row = 0u; row < uint(kCutRows); ++row) {
      if (first + row >= now.count) break;
      const uint code = found[row];
      own += uvec3(code == kCodeDropped ? 0u : 1u, splitsOf(code), leftOver(code, list[now.readAt + first + row].x, splitLevels));
    }
    barrier();
    line[me] = own;
    barrier();
    for (uint distance_ = 1u; distance_ < uint(kCutGroup); distance_ *= 2u) {
      uvec3 upTo = line[me];
      if (me >= distance_) upTo += line[me - distance_];
      barrier();
      line[me] = upTo;
      barrier();
    }
    uvec3 at = tiles[tile].xyz + line[me] - own;
    for (uint row = 0u; row < uint(kCutRows); ++row) {
      if (first + row >= now.count) break;
      const uint code = found[row];
      if (code == kCodeDropped) continue;
      const uvec2 entry = list[now.readAt + first + row];
      const uint view = entry.y & ~kEntryDone;
      const uint splits = (code & kCodeSplit) != 0u ? code : 0u;
      const uint left = leftOver(code, entry.x, splitLevels);
      uint to = now.finishedAt + now.finished + at.x + min(at.y, now.budget), leftTo = now.leftAt + at.z;
#ifndef ORDERED
      if (!full) to -= at.z;
#endif
      const uint room = now.budget - min(now.budget, at.y);
      at += uvec3(1u, bitCount(splits), left);
      if (splits == 0u) {
        list[to] = uvec2(ancestorOf(entry.x, code >> kCodeClimbShift), view | kEntryDone);
#ifdef MARGINS
        margins[to] = margins[now.readAt + first + row];
#endif
        continue;
      }
      // Parents come before children: what remains of the splits is a subtree.
      const uint kept = within(splits, room);
      const bool goesOn = mayGoOn(entry.x, splitLevels);
      uint place = 1u;
      while (place != 0u) {
        if (place < 1u << splitLevels && (kept >> (place - 1u) & 1u) != 0u) {
          place *= 2u;
          continue;
        }
        const uint node = nodeBelow(entry.x, place);
        const bool open = goesOn && place >= 1u << splitLevels;
#ifdef ORDERED
        list[to++] = uvec2(node, open ? view : view | kEntryDone);
#else
        const bool apart = open && !full;
        const uint there = apart ? leftTo++ : to++;
        list[there] = uvec2(node, apart ? view : view | kEntryDone);
#ifdef MARGINS
        margins[there] = 0u;
#endif
#endif
        while ((place & 1u) != 0u) place >>= 1u;
        if (place != 0u) ++place;
      }
    }
  }
}
