// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/triangle_ranges.h"

#include <algorithm>
#include <cassert>

namespace limen::frame {
namespace {

/// Layout as read by glMultiDrawElementsIndirect.
struct DrawCommand {
  uint32_t count, instanceCount, firstIndex;
  int32_t baseVertex;
  uint32_t baseInstance;
};

}  // namespace

TriangleRanges::TriangleRanges(size_t capacity)
    : capacity_(capacity),
      ranges_(static_cast<int64_t>(capacity * sizeof(glm::uvec2)), nullptr),
      commands_(static_cast<int64_t>(capacity * sizeof(DrawCommand)), nullptr) {}

void TriangleRanges::set(std::vector<scene::TriangleRange> given) {
  std::sort(given.begin(), given.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<scene::TriangleRange> merged;
  for (const scene::TriangleRange& range : given) {
    if (range.count == 0) continue;
    if (!merged.empty() && merged.back().first + merged.back().count == range.first)
      merged.back().count += range.count;
    else
      merged.push_back(range);
  }
  assert(merged.size() <= capacity_);
  std::vector<glm::uvec2> ranges;
  std::vector<DrawCommand> commands;
  triangleCount_ = 0;
  for (const scene::TriangleRange& range : merged) {
    triangleCount_ += range.count;
    commands.push_back({3 * range.count, 1, 3 * range.first, 0, static_cast<uint32_t>(ranges.size())});
    ranges.emplace_back(range.first, triangleCount_);
  }
  rangeCount_ = static_cast<int>(merged.size());
  if (merged.empty()) return;
  ranges_.write(0, static_cast<int64_t>(ranges.size() * sizeof(glm::uvec2)), ranges.data());
  commands_.write(0, static_cast<int64_t>(commands.size() * sizeof(DrawCommand)), commands.data());
}

}  // namespace limen::frame
