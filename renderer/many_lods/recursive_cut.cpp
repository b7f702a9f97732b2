// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/recursive_cut.h"

#include <bit>

#include "renderer/many_lods/node_predicate.h"

namespace limen::many_lods {
namespace {

/// First leaf below a node and the number of leaves, from left to right.
struct LeafRun {
  uint32_t first = 0, count = 0;
};

template <class RunOf>
CutFaults faults(const std::vector<glm::uvec2>& list, uint32_t views, uint32_t leaves, const RunOf& runOf) {
  // Differences of how many nodes are above each leaf.
  std::vector<std::vector<int32_t>> steps(views);
  for (const glm::uvec2 entry : list) {
    std::vector<int32_t>& of = steps[entry.y];
    if (of.empty()) of.resize(size_t{leaves} + 1);
    const LeafRun run = runOf(entry.x);
    ++of[run.first];
    --of[run.first + run.count];
  }
  CutFaults out;
  for (const std::vector<int32_t>& of : steps) {
    if (of.empty()) {
      out.uncovered += leaves;
      continue;
    }
    int32_t above = 0;
    for (uint32_t leaf = 0; leaf < leaves; ++leaf) {
      above += of[leaf];
      out.uncovered += above == 0 ? 1 : 0;
      out.doubled += above > 1 ? 1 : 0;
    }
  }
  return out;
}

LeafRun runInCompleteTree(uint32_t node, int depth) {
  const int below = depth + 1 - std::bit_width(node);
  return {(node << below) - (1U << depth), 1U << below};
}

bool isValidIn(const SphereTree& tree, uint32_t node, const CutView& view) {
  if (tree.links.empty()) return isValid(tree.spheres[node], node, tree.leafCount(), view);
  if (tree.links[node].firstChild == 0) return true;
  // As in a complete tree whose levels are as many as the node's height.
  return isValid(tree.spheres[node], 1, 1U << tree.links[node].height % 32, view);
}

}  // namespace

std::vector<uint32_t> recursiveCut(const std::vector<glm::vec4>& spheres, int depth, const CutView& view) {
  std::vector<uint32_t> out, open = {kRootNode};
  const uint32_t leaves = 1U << depth;
  while (!open.empty()) {
    const uint32_t node = open.back();
    open.pop_back();
    if (isValid(spheres[node], node, leaves, view)) {
      out.push_back(node);
    } else {
      open.push_back(2 * node + 1);
      open.push_back(2 * node);
    }
  }
  return out;
}

std::vector<uint32_t> recursiveCut(const SphereTree& tree, const CutView& view, int arityBits) {
  std::vector<uint32_t> out, open = {kRootNode};
  while (!open.empty()) {
    const uint32_t node = open.back();
    open.pop_back();
    if (isValidIn(tree, node, view)) {
      out.push_back(node);
      continue;
    }
    const uint32_t first = tree.links.empty() ? node << arityBits : tree.links[node].firstChild;
    for (uint32_t child = 1U << arityBits; child > 0; --child) open.push_back(first + child - 1);
  }
  return out;
}

CutFaults faultsOf(const std::vector<glm::uvec2>& list, uint32_t views, int depth) {
  return faults(list, views, 1U << depth, [&](uint32_t node) { return runInCompleteTree(node, depth); });
}

CutFaults faultsOf(const std::vector<glm::uvec2>& list, uint32_t views, const SphereTree& tree) {
  if (tree.links.empty()) return faultsOf(list, views, tree.depth);
  std::vector<uint32_t> firstLeaf(tree.links.size());
  for (uint32_t node = kRootNode; node < tree.links.size(); ++node)
    if (const uint32_t child = tree.links[node].firstChild; child != 0) {
      firstLeaf[child] = firstLeaf[node];
      firstLeaf[child + 1] = firstLeaf[node] + tree.links[child].leaves;
    }
  return faults(list, views, tree.leafCount(), [&](uint32_t node) {
    return LeafRun{firstLeaf[node], tree.links[node].leaves};
  });
}

}  // namespace limen::many_lods
