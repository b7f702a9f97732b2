// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "renderer/surfaces/patch_set.h"

namespace limen::surfaces {

/// Two sides with the same ends but different curves, as PN triangles have where their normals differ at a
/// common vertex: between the curves the surface has a gap, whatever the tessellation. (Schwarz 2009, section
/// 7.5.2; SC-63)
struct InherentGap {
  std::array<uint32_t, 2> patches;  ///< ascending
  std::array<int, 2> sides;         ///< they run in opposite directions
  /// 0 or 1: the patch whose normals a strip across the gap takes. Of the two flat faces, through a patch's
  /// corners, it is the one that deviates less from the mean face normal of a strip of two segments.
  int normalsFrom = 0;
};

/// All of them, in the order of the first patch. Neighbours must have been found. Sides that run the same way
/// or whose ends three or more sides share are left out.
std::vector<InherentGap> inherentGaps(const PatchSet& set);

}  // namespace limen::surfaces
