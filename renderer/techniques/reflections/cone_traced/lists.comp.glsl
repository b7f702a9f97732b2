// SPDX-License-Identifier: BSD-3-Clause
// From gathered pairs to a list of triangles for each tile: where each list begins, then each pair's triangle at its place.
#include "renderer/techniques/reflections/cone_traced/cone_traced_bindings.h"
#include "renderer/techniques/reflections/ray_hierarchy/ray_hierarchy_bindings.h"

layout(local_size_x = kConeGroup) in;
layout(std430, binding = kConeGatheredBuffer) readonly buffer Gathered { uint gathered[]; };
layout(std430, binding = kConeSumsBuffer) readonly buffer Sums { uint sums[]; };
layout(std430, binding = kConeTilesBuffer) readonly buffer Tiles { uint tiles[]; };
layout(std430, binding = kConeListsBuffer) writeonly buffer Lists { uint lists[]; };
uniform uint tileCount, gatheredRoom;

void main() {
  const uint stride = gl_NumWorkGroups.x * uint(kConeGroup);
  const uint pairs = min(tiles[tileCount], gatheredRoom);
  for (uint i = gl_GlobalInvocationID.x; i < max(pairs, tileCount); i += stride) {
    if (i < tileCount) {
      // The lists of tiles that lack pairs are not looked at.
      lists[2u * i] = sums[i];
      lists[2u * i + 1u] = tiles[tileCount + 4u + i] != 0u ? kConeUnlisted : tiles[i];
    }
    if (i < pairs) lists[2u * tileCount + sums[gathered[3u * i]] + gathered[3u * i + 1u]] = gathered[3u * i + 2u];
  }
}
