// SPDX-License-Identifier: BSD-3-Clause
// What the shaders that build a tree over triangles are bound to (rebuilt_tree.h). For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::ray_tracing {
#endif

const int kTreeGroup = 256;
const int kTreeDigits = 256;        // of a pass of the sort: 8 bits
const int kTreeSortRounds = 4;      // of kTreeGroup items each, that a group takes in a pass
const int kTreeCollapseGroup = 64;  // eight invocations a node of the wide tree
const int kTreeAloneGroup = 512;    // of the one group that takes levels of few nodes
const uint kTreeNone = 0xffffffffu;
const uint kTreeMostLeaf = 3u;  // triangles of a leaf

// A node of the binary tree; leaves, of a triangle each, follow the inner nodes. std430.
struct BinaryNode {
  vec3 low;
  uint left;
  vec3 high;
  uint right;
  uint first, count;  // triangles in the sorted order
  uint height;        // levels of nodes of more than kTreeMostLeaf triangles
  uint unused;
};
struct TreeControl {  // std430
  uint high[3];       // of the triangles' centres, as words in their order; 0: none yet
  uint low[3];        // complements
  uint valid;         // triangles in the tree
  uint root;
  uint nodes, triangles;  // of the wide tree so far
  uint levelFirst, levelEnd;
  uint groupsX, groupsY, groupsZ;  // of the next level
  uint groupsDone;
  uint level;  // of the wide tree; in the end: how many
  uint unused0, unused1, unused2;
};
#ifdef __cplusplus
static_assert(sizeof(BinaryNode) == 48 && offsetof(BinaryNode, right) == 28 &&
              offsetof(BinaryNode, first) == 32);
static_assert(sizeof(TreeControl) == 80 && offsetof(TreeControl, groupsX) == 48);
#endif

const uint kTreePositionsBuffer = 0u;
const uint kTreeIndicesBuffer = 1u;
const uint kTreeControlBuffer = 2u;
const uint kTreeKeysBuffer = 3u;
const uint kTreeOrderBuffer = 4u;
const uint kTreeNodesBuffer = 5u;
const uint kTreeRangesBuffer = 6u;
// Sort.
const uint kTreeKeysOutBuffer = 5u;
const uint kTreeOrderOutBuffer = 6u;
const uint kTreeCountsBuffer = 7u;
// Wide tree.
const uint kTreeTasksBuffer = 3u;
const uint kTreeWideNodesBuffer = 6u;
const uint kTreeWideTrianglesBuffer = 7u;

#ifdef __cplusplus
}  // namespace limen::ray_tracing
#endif
