// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/hybrid_cuts.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>

#include "experiments/base/error.h"
#include "renderer/many_lods/node_predicate.h"

namespace limen::many_lods {
namespace {

uint32_t levelOf(uint32_t node) { return static_cast<uint32_t>(std::bit_width(node)) - 1; }

/// As splitsBelow() in cut_classify.comp.glsl, of binary trees.
uint32_t splitsBelow(const std::vector<glm::vec4>& nodes, uint32_t node, uint32_t leaves, uint32_t levels,
                     const CutView& view) {
  uint32_t mask = kCodeSplit;
  for (uint32_t place = 2; place < 1U << levels; ++place) {
    if ((mask >> ((place >> 1U) - 1U) & 1U) == 0) continue;
    const uint32_t level = levelOf(place), there = (node << level) + place - (1U << level);
    if (!isValid(nodes[there], there, leaves, view)) mask |= 1U << (place - 1U);
  }
  return mask;
}

uint32_t leftOver(uint32_t code, uint32_t node, uint32_t leaves, uint32_t levels) {
  if ((code & kCodeSplit) == 0 || (uint64_t{node} << levels) >= leaves) return 0;
  return 2 * static_cast<uint32_t>(std::popcount(code >> ((1U << (levels - 1U)) - 1U)));
}

uint32_t groupsOf(uint32_t count, uint32_t each) {
  return std::min((count + each - 1) / each, static_cast<uint32_t>(kMostCutGroups));
}

}  // namespace

HybridCuts::HybridCuts(gl::Context& context, uint32_t views, const TreeShape& shape, uint32_t capacity,
                       const HybridSettings& settings)
    : ListedCuts(context, views, shape, capacity, BasicCuts{.order = CutOrder::Kept}),
      settings_(settings),
      firstHalf_(&context.programs().compute("renderer/many_lods/cut_classify.comp.glsl",
                                             {{"RULE", "0"}, {"FIRST_HALF", "1"}})) {
  if (shape.links)
    throw Error("cuts that CPU and GPU share are of complete trees", "cuts",
                "choose other cuts, or a balanced tree");
}

// What the CPU tests is not counted, so that neither is what the GPU does.
void HybridCuts::update(const gl::Buffer& nodes, const gl::Buffer& views, bool) {
  views_ = views.read<CutView>(0, int64_t{viewCount_});
  if (const auto* top = std::get_if<TopOnCpu>(&settings_.share)) {
    const uint32_t levels =
        std::min(static_cast<uint32_t>(top->levels), static_cast<uint32_t>(shape_.height));
    nodes_ = nodes.read<glm::vec4>(0, int64_t{2} << levels);
    const bool whole = writeTop(levels);
    begin(nodes, views, false);
    const uint32_t left = static_cast<uint32_t>(shape_.height) - (whole ? levels : 0);
    // What the CPU has found is looked at once more, by the first of them.
    const uint32_t steps = std::max((left + splitLevels_ - 1) / splitLevels_, 1U);
    for (uint32_t i = 0; i < steps; ++i) ListedCuts::step(kRuleSplit, i, steps - 1, false);
    end();
    return;
  }
  if (std::get<SharedSteps>(settings_.share).events != CutProcessor::Gpu) nodes_ = nodes.read<glm::vec4>();
  ListedCuts::update(nodes, views, false);
}

bool HybridCuts::writeTop(uint32_t levels) {
  // Views share the room alike; where one has no more, the GPU goes on with what is left.
  const uint32_t leaves = 1U << shape_.height, room = capacity_ / viewCount_;
  std::vector<std::vector<glm::uvec2>> cuts(viewCount_);
  std::atomic<bool> whole = true;
  pool_.run(viewCount_, [&](uint32_t number) {
    std::vector<uint32_t> open = {kRootNode};
    while (!open.empty()) {
      const uint32_t node = open.back();
      open.pop_back();
      const bool full = cuts[number].size() + open.size() + 2 > room;
      if (levelOf(node) == levels || full || isValid(nodes_[node], node, leaves, views_[number])) {
        if (full && levelOf(node) < levels) whole = false;
        cuts[number].emplace_back(node, number);
      } else {
        open.push_back(2 * node + 1);
        open.push_back(2 * node);
      }
    }
  });
  std::vector<glm::uvec2> list;
  for (const std::vector<glm::uvec2>& cut : cuts) list.insert(list.end(), cut.begin(), cut.end());
  list_.write(0, static_cast<int64_t>(list.size() * sizeof(glm::uvec2)), list.data());
  const std::array<uint32_t, 2> start = {static_cast<uint32_t>(list.size()), 0U};
  static_assert(offsetof(CutControl, readAt) == offsetof(CutControl, count) + 4);
  control_.write(offsetof(CutControl, count), sizeof start, start.data());
  return whole;
}

void HybridCuts::step(uint32_t rule, uint32_t number, uint32_t last, bool counting) {
  const auto& share = std::get<SharedSteps>(settings_.share);
  const gl::Program& classify = configure(rule, last, counting);
  const int64_t at = sizeof(CutControl) + int64_t{number} * sizeof(CutStep);
  const bool onGpuAlone = share.events == CutProcessor::Gpu && share.sums == CutSums::Gpu;
  const CutStep now = onGpuAlone ? CutStep{} : control_.read<CutStep>(at, 1)[0];
  if (!onGpuAlone && now.count == 0) return;
  const uint32_t tiles = (now.count + kCutTile - 1) / kCutTile;
  if (share.events == CutProcessor::Gpu) {
    dispatch(classify, number, offsetof(CutStep, classifyX));
  } else if (share.events == CutProcessor::Both) {
    firstHalf_->set("splitLevels", splitLevels_);
    dispatch(*firstHalf_, number, offsetof(CutStep, classifyX));
    findEvents(now, tiles / 2, tiles);
  } else {
    findEvents(now, 0, tiles);
  }
  if (share.sums == CutSums::Gpu)
    dispatch(*scan_, number, offsetof(CutStep, scanX));
  else
    sumUp(now, number, last);
  dispatch(*emit_, number, offsetof(CutStep, emitX));
}

void HybridCuts::findEvents(const CutStep& now, uint32_t firstTile, uint32_t endTile) {
  const uint32_t leaves = 1U << shape_.height;
  const auto tasks = static_cast<uint32_t>(std::get<SharedSteps>(settings_.share).eventTasks);
  for (uint32_t task = 0; task < tasks; ++task) {
    const auto bound = [&](uint32_t of) { return firstTile + (endTile - firstTile) * of / tasks; };
    const uint32_t from = bound(task), to = bound(task + 1);
    if (from == to) continue;
    const uint32_t first = from * kCutTile, end = std::min(to * uint32_t{kCutTile}, now.count);
    const std::vector<glm::uvec2> list = list_.read<glm::uvec2>(
        int64_t{sizeof(glm::uvec2)} * (int64_t{now.readAt} + first), int64_t{end} - first);
    std::vector<uint32_t> codes(size_t{to - from} * kCutTile, kCodeDropped);
    std::vector<glm::uvec4> sums(to - from, glm::uvec4(0));
    pool_.run(to - from, [&](uint32_t tile) {
      for (uint32_t i = tile * kCutTile; i < std::min((tile + 1) * uint32_t{kCutTile}, end - first); ++i) {
        const uint32_t node = list[i].x;
        const CutView& view = views_[list[i].y & ~kEntryDone];
        codes[i] = isValid(nodes_[node], node, leaves, view)
                       ? 0U
                       : splitsBelow(nodes_, node, leaves, splitLevels_, view);
        const bool split = (codes[i] & kCodeSplit) != 0;
        sums[tile] += glm::uvec4(1U, split ? std::popcount(codes[i]) : 0,
                                 leftOver(codes[i], node, leaves, splitLevels_), 0U);
      }
    });
    codes_.write(int64_t{4} * first, static_cast<int64_t>(4 * codes.size()), codes.data());
    tiles_.write(int64_t{16} * from, static_cast<int64_t>(16 * sums.size()), sums.data());
  }
}

/// As cut_scan.comp.glsl.
void HybridCuts::sumUp(CutStep now, uint32_t number, uint32_t last) {
  const uint32_t tileCount = (now.count + kCutTile - 1) / kCutTile;
  const auto tasks = static_cast<uint32_t>(std::get<SharedSteps>(settings_.share).sumTasks);
  glm::uvec3 before(0);
  for (uint32_t task = 0; task < tasks; ++task) {
    const uint32_t from = tileCount * task / tasks, to = tileCount * (task + 1) / tasks;
    if (from == to) continue;
    std::vector<glm::uvec4> tiles = tiles_.read<glm::uvec4>(int64_t{16} * from, int64_t{to} - from);
    for (glm::uvec4& tile : tiles) {
      const glm::uvec3 own(tile);
      tile = glm::uvec4(before, 0U);
      before += own;
    }
    tiles_.write(int64_t{16} * from, static_cast<int64_t>(16 * tiles.size()), tiles.data());
  }
  CutControl control = control_.read<CutControl>(0, 1)[0];
  const int64_t at = sizeof(CutControl) + int64_t{number} * sizeof(CutStep);
  now.budget = capacity_ - now.finished - before.x;
  now.full = before.y > now.budget ? 1U : 0U;
  now.emitX = groupsOf(now.count, kCutTile);
  now.emitY = now.emitZ = 1;
  const uint32_t splits = std::min(before.y, now.budget), left = now.full != 0 ? 0U : before.z;
  const uint32_t made = before.x + splits - left;
  control.refused += before.y - splits;
  control.splits += splits;
  control.steps = number + 1;
  control.count = now.finished + made;
  control.readAt = now.finishedAt;
  control.drawX = groupsOf(control.count, kSplatGroup);
  control.drawY = control.drawZ = 1;
  control_.write(0, sizeof control, &control);
  control_.write(at, sizeof now, &now);
  if (number == last || left == 0) return;
  CutStep next = now;
  next.full = next.budget = 0;
  next.emitX = next.emitY = next.emitZ = 0;
  next.scanX = next.scanY = next.scanZ = 1;
  next.readAt = now.leftAt;
  next.leftAt = now.readAt;
  next.finished = now.finished + made;
  next.count = left;
  next.classifyX = groupsOf(left, kCutTile);
  next.classifyY = next.classifyZ = 1;
  control_.write(at + int64_t{sizeof(CutStep)}, sizeof next, &next);
}

}  // namespace limen::many_lods
