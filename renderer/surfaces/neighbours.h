// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "renderer/surfaces/patch_set.h"

namespace limen::surfaces {

/// Sides of a set of patches, by what lies along them.
struct SideCounts {
  size_t shared = 0;     ///< sides with a neighbour, two for each common boundary
  size_t open = 0;       ///< no other side has the same control points
  size_t collapsed = 0;  ///< all control points of the side are the same point
  size_t crowded = 0;    ///< three or more sides have the same control points: none becomes a neighbour
};

/// Fills set.neighbours. Two sides are neighbours if their control points are the same numbers in the same or
/// the opposite order, so that their curves are; sides of different degree never are.
SideCounts findNeighbours(PatchSet& set);

}  // namespace limen::surfaces
