// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/triangle_bitmask/triangle_bvh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace limen::techniques {
namespace {

constexpr int kSplitBins = 16;
/// Deeper nodes are split in half by count: coincident centres must not degrade the tree to a list.
constexpr int kDeepest = 48;

struct Box3 {
  glm::vec3 low{INFINITY}, high{-INFINITY};
  void extend(const Box3& other) { low = glm::min(low, other.low), high = glm::max(high, other.high); }
  void extend(glm::vec3 p) { low = glm::min(low, p), high = glm::max(high, p); }
  float halfArea() const {
    const glm::vec3 size = glm::max(high - low, 0.0F);
    return size.x * size.y + size.y * size.z + size.z * size.x;
  }
};

class BvhBuilder {
 public:
  explicit BvhBuilder(const std::vector<Corners3>& given) : given_(given), boxes_(given.size()) {
    for (uint32_t i = 0; i < given.size(); ++i) {
      bool finite = true;
      for (const glm::vec3& corner : given[i]) {
        boxes_[i].extend(corner);
        finite = finite && std::isfinite(corner.x) && std::isfinite(corner.y) && std::isfinite(corner.z);
      }
      if (finite) order_.push_back(i);
    }
  }

  TriangleBvh build() && {
    if (order_.empty())
      out_.nodes.push_back({glm::vec3(1.0F), 1, glm::vec3(-1.0F), 0});  // a box that nothing intersects
    else
      node(0, order_.size(), 0);
    return std::move(out_);
  }

 private:
  glm::vec3 centre(uint32_t triangle) const { return boxes_[triangle].low + boxes_[triangle].high; }

  void node(size_t first, size_t end, int depth) {
    const size_t place = out_.nodes.size();
    Box3 box;
    for (size_t i = first; i < end; ++i) box.extend(boxes_[order_[i]]);
    out_.nodes.push_back({box.low, 0, box.high, 0});
    if (end - first <= TriangleBvh::kLeaf) {
      out_.nodes[place].leaf =
          static_cast<uint32_t>(out_.triangles.size() * 8) + static_cast<uint32_t>(end - first);
      for (size_t i = first; i < end; ++i) {
        const Corners3& corners = given_[order_[i]];
        out_.triangles.push_back({corners[0], order_[i], corners[1], 0, corners[2], 0});
      }
    } else {
      const size_t middle = split(first, end, depth);
      node(first, middle, depth + 1);
      node(middle, end, depth + 1);
    }
    out_.nodes[place].skip = static_cast<uint32_t>(out_.nodes.size());
  }

  /// Sorts [first, end) into two halves and returns where the second begins; neither is empty.
  size_t split(size_t first, size_t end, int depth) {
    Box3 centres;
    for (size_t i = first; i < end; ++i) centres.extend(centre(order_[i]));
    const glm::vec3 size = centres.high - centres.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto begin = order_.begin();
    const auto from = begin + static_cast<std::ptrdiff_t>(first),
               to = begin + static_cast<std::ptrdiff_t>(end);
    if (size[axis] > 0.0F && depth < kDeepest) {
      const float scale = static_cast<float>(kSplitBins) / size[axis];
      const auto binOf = [&](uint32_t triangle) {
        return std::min(static_cast<int>((centre(triangle)[axis] - centres.low[axis]) * scale),
                        kSplitBins - 1);
      };
      const int cut = cheapestCut(first, end, binOf);
      const auto middle = std::partition(from, to, [&](uint32_t t) { return binOf(t) < cut; });
      if (middle != from && middle != to) return static_cast<size_t>(middle - begin);
    }
    const auto middle = from + (to - from) / 2;
    std::nth_element(from, middle, to, [&](uint32_t a, uint32_t b) {
      const float left = centre(a)[axis], right = centre(b)[axis];
      return left < right || (left == right && a < b);
    });
    return static_cast<size_t>(middle - begin);
  }

  /// The bin before which a cut minimises the sum of areas times counts.
  template <class BinOf>
  int cheapestCut(size_t first, size_t end, const BinOf& binOf) const {
    std::array<Box3, kSplitBins> bins{};
    std::array<float, kSplitBins> counts{};
    for (size_t i = first; i < end; ++i) {
      const auto bin = static_cast<size_t>(binOf(order_[i]));
      bins.at(bin).extend(boxes_[order_[i]]);
      counts.at(bin) += 1.0F;
    }
    std::array<float, kSplitBins> above{};  // cost of the bins from one on
    Box3 box;
    float count = 0.0F;
    for (size_t bin = kSplitBins; bin-- > 1;) {
      box.extend(bins.at(bin)), count += counts.at(bin);
      above.at(bin) = count > 0.0F ? box.halfArea() * count : 0.0F;
    }
    int best = 1;
    float bestCost = INFINITY;
    box = Box3();
    count = 0.0F;
    for (size_t bin = 1; bin < kSplitBins; ++bin) {
      box.extend(bins.at(bin - 1)), count += counts.at(bin - 1);
      const float cost = (count > 0.0F ? box.halfArea() * count : 0.0F) + above.at(bin);
      if (cost < bestCost) best = static_cast<int>(bin), bestCost = cost;
    }
    return best;
  }

  const std::vector<Corners3>& given_;
  std::vector<Box3> boxes_;
  std::vector<uint32_t> order_;
  TriangleBvh out_;
};

}  // namespace

TriangleBvh buildTriangleBvh(const std::vector<Corners3>& triangles) { return BvhBuilder(triangles).build(); }

}  // namespace limen::techniques
