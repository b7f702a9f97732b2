// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/many_lods/sphere_tree.h"

namespace limen::many_lods {

/// No leaf is farther from the root than this.
inline constexpr int kMostTreeHeight = 30;

/// A binary tree over the same points as buildSphereTree(), each of whose runs is split where the bounding
/// spheres of both sides have the least volume in sum, however many points these have: among 63 places along
/// each axis, and at the median where no height is left for anything else. Nodes are numbered level by level
/// from the root, so that children follow each other and parents come first; SphereTree::links says what
/// hangs together. Source: Holländer 2013, section 3.8 ("unbalanced", by links); places and bound are the
/// bench's own.
SphereTree buildUnbalancedTree(const std::vector<glm::dvec3>& positions,
                               const std::vector<glm::uvec3>& triangles, glm::dvec3 anchor,
                               const TreeBuildSettings& settings);

}  // namespace limen::many_lods
