// SPDX-License-Identifier: BSD-3-Clause
// Tiles of cones: nodes of the last level, and what was gathered for each. See PairTraversal::tiles(). The including shader
// declares `sizePx` before.
#include "renderer/techniques/reflections/ray_hierarchy/ray_hierarchy_bindings.h"

#define TILES
#ifndef TILES_ACCESS
#define TILES_ACCESS
#endif
layout(std430, binding = kHierarchyHitsBuffer) TILES_ACCESS buffer Tiles { uint tiles[]; };
uniform uint leafLevel, tileCount;

uint tileOf(ivec2 at) { return uint(at.y * ((sizePx.x + (1 << leafLevel) - 1) >> leafLevel) + at.x); }
uint tileGathered() { return tileCount; }
uint tileCutShort() { return tileCount + 1u; }
uint tileLacks(uint tile) { return tileCount + 4u + tile; }
