// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/many_lods/sphere_tree.h"

namespace limen::many_lods {

/// The cut for one view by recursion from the root on the CPU, from left to right: what MultiCut is compared
/// with.
std::vector<uint32_t> recursiveCut(const std::vector<glm::vec4>& spheres, int depth, const CutView& view);
/// Of any tree; a complete one has 2^arityBits children to a node.
std::vector<uint32_t> recursiveCut(const SphereTree& tree, const CutView& view, int arityBits = 1);

/// What is wrong with cuts: leaves of all views that are under no node, and that are under more than one.
struct CutFaults {
  uint64_t uncovered = 0, doubled = 0;
};
CutFaults faultsOf(const std::vector<glm::uvec2>& list, uint32_t views, int depth);
CutFaults faultsOf(const std::vector<glm::uvec2>& list, uint32_t views, const SphereTree& tree);

}  // namespace limen::many_lods
