// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/ray_tracing/tree_build.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>
#include <utility>

namespace limen::ray_tracing {
namespace {

constexpr uint32_t kLeaf = 3;
constexpr int kBins = 16;
constexpr uint32_t kShared = 1 << 16;  ///< from this many primitives on, all cores work on one run
/// Runs shorter than this are left to one core each.
constexpr uint32_t kShortest = 1 << 10;

size_t cores() { return std::max<size_t>(std::thread::hardware_concurrency(), 1); }

/// Calls work(piece) for `pieces` pieces on all cores.
template <class Work>
void onAllCores(size_t pieces, const Work& work) {
  std::atomic<size_t> next = 0;
  const auto run = [&] {
    for (size_t piece = next++; piece < pieces; piece = next++) work(piece);
  };
  std::vector<std::jthread> helpers;
  for (size_t i = 1; i < std::min(cores(), pieces); ++i) helpers.emplace_back(run);
  run();
}

struct Bounds {
  TreeBox box, centres;
  void extend(const Bounds& other) { box.extend(other.box), centres.extend(other.centres); }
};

/// Bins of one axis.
struct Bins {
  std::array<TreeBox, kBins> box;
  std::array<uint32_t, kBins> count{};
  void extend(const Bins& other) {
    for (size_t i = 0; i < kBins; ++i) box[i].extend(other.box[i]), count[i] += other.count[i];
  }
};
using BinsOfAxes = std::array<Bins, 3>;

/// result += part(first, last) over pieces of a run. What is summed does not depend on the order.
template <class Result, class Part>
Result gather(uint32_t first, uint32_t count, const Part& part) {
  Result result{};
  if (count < kShared) {
    part(first, first + count, result);
    return result;
  }
  const size_t pieces = cores();
  std::vector<Result> results(pieces);
  onAllCores(pieces, [&](size_t i) {
    const auto at = [&](size_t piece) {
      return first + static_cast<uint32_t>(uint64_t{count} * piece / pieces);
    };
    part(at(i), at(i + 1), results[i]);
  });
  for (const Result& one : results) result.extend(one);
  return result;
}

struct Gathered : BinsOfAxes {
  void extend(const Gathered& other) {
    for (size_t axis = 0; axis < 3; ++axis) (*this)[axis].extend(other[axis]);
  }
};

/// Which of the bins a centre lies in.
struct Binning {
  glm::vec3 low;
  glm::vec3 scale{0.0F};  ///< 0: the centres do not differ
  explicit Binning(const TreeBox& centres) : low(centres.low) {
    for (int axis = 0; axis < 3; ++axis) {
      const float extent = centres.high[axis] - centres.low[axis];
      const float quotient = kBins / extent;
      if (extent > 0.0F && std::isfinite(extent) && std::isfinite(quotient)) scale[axis] = quotient;
    }
  }
  int operator()(glm::vec3 centre, int axis) const {
    return std::clamp(static_cast<int>((centre[axis] - low[axis]) * scale[axis]), 0, kBins - 1);
  }
};

/// Children by the octant of the node in which they lie, as far as they do not contend for it: the child that
/// is farthest out chooses first.
std::array<int, 8> slotsOf(const TreeNode& node, const TreeBox& box) {
  std::array<int, 8> childOf;
  childOf.fill(-1);
  std::array<bool, 8> placed{};
  const glm::dvec3 middle = 0.5 * (glm::dvec3(box.low) + glm::dvec3(box.high));
  for (int n = 0; n < node.count; ++n) {
    double most = 0.0;
    int bestChild = -1, bestSlot = -1;
    for (int child = 0; child < node.count; ++child) {
      if (placed[size_t(child)]) continue;
      const TreeBox& of = node.children[size_t(child)].box;
      const glm::dvec3 from = 0.5 * (glm::dvec3(of.low) + glm::dvec3(of.high)) - middle;
      for (int slot = 0; slot < 8; ++slot) {
        if (childOf[size_t(slot)] >= 0) continue;
        const double along =
            (slot & 4 ? from.x : -from.x) + (slot & 2 ? from.y : -from.y) + (slot & 1 ? from.z : -from.z);
        if (bestChild < 0 || along > most) most = along, bestChild = child, bestSlot = slot;
      }
    }
    childOf[size_t(bestSlot)] = bestChild;
    placed[size_t(bestChild)] = true;
  }
  return childOf;
}

class Build {
 public:
  explicit Build(std::vector<TreePrimitive>& primitives) : primitives_(primitives) {}

  TreeChild run(uint32_t first, uint32_t count) const {
    const Bounds around = bounds(first, count);
    return {first, count, around.box, around.centres, nullptr};
  }

  /// Divides a run among eight children at most; `balanced`: as evenly as it goes.
  std::unique_ptr<TreeNode> divide(const TreeChild& whole, bool balanced) const {
    auto node = std::make_unique<TreeNode>();
    node->children[0] = {whole.first, whole.count, whole.box, whole.centres, nullptr};
    node->count = 1;
    while (node->count < 8) {
      int best = -1;
      std::pair<double, uint32_t> most;
      // What costs most: the chance to meet it times what is tested then; the longest if it is alike. Leaves
      // last.
      for (const bool leaves : {false, true}) {
        for (int i = 0; i < node->count; ++i) {
          const TreeChild& child = node->children[static_cast<size_t>(i)];
          if (child.count < 2 || (child.count <= kLeaf) != leaves) continue;
          const double area = balanced ? 0.0 : child.box.halfArea();
          const std::pair cost(leaves ? area * child.count : area, child.count);
          if (best < 0 || cost > most) best = i, most = cost;
        }
        if (best >= 0) break;
      }
      if (best < 0) break;
      TreeChild& left = node->children[static_cast<size_t>(best)];
      const uint32_t first = left.first, count = left.count,
                     half = split(first, count, left.centres, balanced);
      left = run(first, half);
      node->children[static_cast<size_t>(node->count++)] = run(first + half, count - half);
    }
    return node;
  }

  /// All levels below `child`, by one core.
  void finish(TreeChild& child, int levels) const {
    if (child.count <= kLeaf) return;
    expand(child, levels);
    for (int i = 0; i < child.node->count; ++i)
      finish(child.node->children[static_cast<size_t>(i)], levels - 1);
  }

  /// Unless what is left to a child holds everything, whatever it is given, the division is balanced.
  void expand(TreeChild& child, int levels) const {
    child.node = divide(child, child.count > capacity(levels - 1));
    child.node->childOf = slotsOf(*child.node, child.box);
  }

  /// Most primitives that a balanced tree of so many levels holds.
  static uint64_t capacity(int levels) { return uint64_t{kLeaf} << (3 * std::min(levels, 20)); }

 private:
  Bounds bounds(uint32_t first, uint32_t count) const {
    return gather<Bounds>(first, count, [&](uint32_t from, uint32_t to, Bounds& out) {
      for (uint32_t i = from; i < to; ++i)
        out.box.extend(primitives_[i].box), out.centres.extend(primitives_[i].centre());
    });
  }

  /// Orders a run so that its first so many primitives are one half.
  uint32_t split(uint32_t first, uint32_t count, const TreeBox& centres, bool balanced) const {
    if (!balanced)
      if (const uint32_t half = splitByArea(first, count, centres); half > 0) return half;
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (centres.high[i] - centres.low[i] > centres.high[axis] - centres.low[axis]) axis = i;
    const auto begin = primitives_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count,
                     [&](const TreePrimitive& a, const TreePrimitive& b) {
                       const float x = a.centre()[axis], y = b.centre()[axis];
                       return x < y || (x == y && a.triangle < b.triangle);
                     });
    return count / 2;
  }

  /// 0: all centres are alike.
  uint32_t splitByArea(uint32_t first, uint32_t count, const TreeBox& centres) const {
    const Binning binning(centres);
    const auto bins = gather<Gathered>(first, count, [&](uint32_t from, uint32_t to, Gathered& out) {
      for (uint32_t i = from; i < to; ++i) {
        const glm::vec3 centre = primitives_[i].centre();
        for (int axis = 0; axis < 3; ++axis) {
          const auto bin = static_cast<size_t>(binning(centre, axis));
          out[size_t(axis)].box[bin].extend(primitives_[i].box);
          ++out[size_t(axis)].count[bin];
        }
      }
    });
    double least = std::numeric_limits<double>::infinity();
    int bestAxis = -1, bestBin = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(binning.scale[axis] > 0.0F)) continue;
      const Bins& of = bins[size_t(axis)];
      std::array<double, kBins> above{};  // cost of the bins from i on
      TreeBox box;
      uint32_t number = 0;
      for (size_t i = kBins; i-- > 1;) {
        box.extend(of.box[i]), number += of.count[i];
        above[i] = box.halfArea() * number;
      }
      box = {}, number = 0;
      for (size_t i = 1; i < kBins; ++i) {
        box.extend(of.box[i - 1]), number += of.count[i - 1];
        if (number == 0 || number == count) continue;
        const double cost = box.halfArea() * number + above[i];
        if (cost < least) least = cost, bestAxis = axis, bestBin = static_cast<int>(i);
      }
    }
    if (bestAxis < 0) return 0;
    const auto begin = primitives_.begin() + first;
    const auto middle = std::partition(begin, begin + count, [&](const TreePrimitive& primitive) {
      return binning(primitive.centre(), bestAxis) < bestBin;
    });
    return static_cast<uint32_t>(middle - begin);
  }

  std::vector<TreePrimitive>& primitives_;
};

}  // namespace

double TreeBox::halfArea() const {
  if (low.x > high.x) return 0.0;
  const glm::dvec3 extent = glm::dvec3(high) - glm::dvec3(low);
  return extent.x * extent.y + extent.y * extent.z + extent.z * extent.x;
}

TreeChild buildTree(std::vector<TreePrimitive>& primitives, int levels) {
  const Build build(primitives);
  TreeChild root = build.run(0, static_cast<uint32_t>(primitives.size()));
  build.expand(root, levels);  // a root even of one leaf

  // From the top, all cores on one node, until there is enough to hand out; then a core a run.
  struct Open {
    TreeChild* child;
    int levels;
  };
  std::vector<Open> open;
  const auto openChildren = [&](TreeChild& of, int below) {
    for (int i = 0; i < of.node->count; ++i)
      if (of.node->children[static_cast<size_t>(i)].count > kLeaf)
        open.push_back({&of.node->children[static_cast<size_t>(i)], below});
  };
  openChildren(root, levels - 1);
  const auto expandAll = [&](std::vector<Open> some) {
    onAllCores(some.size(), [&](size_t i) { build.expand(*some[i].child, some[i].levels); });
    for (const Open& one : some) openChildren(*one.child, one.levels - 1);
  };
  const auto isShorter = [](const Open& a, const Open& b) { return a.child->count < b.child->count; };
  while (!open.empty() && open.size() < 16 * cores()) {
    const auto longest = std::max_element(open.begin(), open.end(), isShorter);
    if (longest->child->count >= kShared) {
      const Open taken = *longest;
      open.erase(longest);
      expandAll({taken});
    } else if (longest->child->count >= kShortest) {
      expandAll(std::exchange(open, {}));
    } else {
      break;
    }
  }
  onAllCores(open.size(), [&](size_t i) { build.finish(*open[i].child, open[i].levels); });
  return root;
}

}  // namespace limen::ray_tracing
