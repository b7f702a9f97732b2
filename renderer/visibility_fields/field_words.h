// SPDX-License-Identifier: BSD-3-Clause
// Where the words of a field lie: maps are tiles, packed row by row into the slices of an array texture
// (Gaitatzes 2012, Fig. 28). For C++ and GLSL.
#pragma once

#include "renderer/visibility_fields/map_functions.h"

#ifdef __cplusplus
namespace limen::visibility_fields {
using glm::ivec3;
using glm::uint;
#endif

// x, y and slice of a word of map `map`: column and row in the map. `tile`: words of a map along x and y;
// `side`: of a slice.
FIELD_FUNCTION ivec3 fieldWordPlace(int map, ivec2 word, ivec2 tile, int side) {
  // Sides are powers of two and known to the compiler: without signs no division is left.
  const uint across = uint(side / tile.x), each = across * uint(side / tile.y), number = uint(map);
  const uint inSlice = number % each;
  return ivec3(ivec2(int(inSlice % across), int(inSlice / across)) * tile + word, int(number / each));
}

#ifdef __cplusplus
}  // namespace limen::visibility_fields
#endif
