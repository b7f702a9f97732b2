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
#ifdef RESUMED
layout(std430, binding = kConeRoundsBuffer) writeonly buffer Rounds { uint rounds[]; };
uniform uint triangleCount;
uniform ivec2 roundGroups;
#endif

void main() {
  const uint stride = gl_NumWorkGroups.x * uint(kConeGroup);
  const uint pairs = min(tiles[tileCount], gatheredRoom);
  for (uint i = gl_GlobalInvocationID.x; i < max(pairs, tileCount); i += stride) {
    if (i < tileCount) {
      // The lists of tiles that lack pairs are not looked at; where a search ended early, any tile may lack some.
      const bool lacks = tiles[tileCount + 4u + i] != 0u || tiles[tileCount + 1u] != 0u;
      lists[2u * i] = sums[i];
      lists[2u * i + 1u] = lacks ? kConeUnlisted : tiles[i];
#ifdef RESUMED
      // All tiles write the same.
      const uint number = lacks ? triangleCount : tiles[i];
      for (uint r = 1u; r * kConeEntriesPerRound < number; ++r) {
        rounds[3u * r] = uint(roundGroups.x);
        rounds[3u * r + 1u] = uint(roundGroups.y);
        rounds[3u * r + 2u] = 1u;
      }
#endif
    }
    if (i < pairs) lists[2u * tileCount + sums[gathered[3u * i]] + gathered[3u * i + 1u]] = gathered[3u * i + 2u];
  }
}
