// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/multi_cut.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <string>

#include "experiments/base/error.h"
#include "renderer/many_lods/node_predicate.h"

namespace limen::many_lods {
namespace {

template <class S>
const SettingsTable<S>& noParameters() {
  static const SettingsTable<S> kTable = {};
  return kTable;
}

template <class S>
const SettingsTable<S>& edgesTable() {
  static const SettingsTable<S> kTable = {{&S::edges,
                                           "edges",
                                           {1, 24},
                                           "",
                                           "Edges of the tree by which an entry may move in a frame",
                                           "Holländer 2013, section 3.5.2 (q)"}};
  return kTable;
}

uint32_t tilesFor(uint32_t entries) { return (entries + kCutTile - 1) / kCutTile; }

gl::Buffer storage(int64_t bytes) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  if (bytes > most)
    throw Error("the lists of cuts take " + std::to_string(bytes) +
                    " bytes in one buffer; this device allows " + std::to_string(most),
                {}, "lower 'room', the number of views, or the size of the picture");
  return {bytes, nullptr};
}

constexpr int64_t kEntryBytes = 8;
constexpr int kRuleCount = 4;

}  // namespace

const SettingsTable<BasicCuts>& BasicCuts::table() { return noParameters<BasicCuts>(); }
const SettingsTable<IncrementalCuts>& IncrementalCuts::table() { return noParameters<IncrementalCuts>(); }
const SettingsTable<LazyCuts>& LazyCuts::table() { return edgesTable<LazyCuts>(); }
const SettingsTable<LiteralCuts>& LiteralCuts::table() { return edgesTable<LiteralCuts>(); }

MultiCut::MultiCut(gl::Context& context, uint32_t views, int depth, uint32_t capacity, const CutMode& mode)
    : mode_(mode),
      views_(views),
      leaves_(1U << depth),
      capacity_(capacity),
      fullSteps_(static_cast<uint32_t>(std::max((depth + kSplitLevels - 1) / kSplitLevels, 1))),
      list_(storage(2 * kEntryBytes * capacity)),
      codes_(storage(4 * int64_t{kCutTile} * tilesFor(capacity))),
      tiles_(8 * int64_t{tilesFor(capacity)}, nullptr),
      control_(sizeof(CutControl) + kMostCutSteps * int64_t{sizeof(CutStep)}, nullptr) {
  if (views > capacity)
    throw Error("the lists of cuts have room for " + std::to_string(capacity) + " nodes; there are " +
                    std::to_string(views) + " views",
                {}, "raise the capacity");
  gl::ProgramCache& cache = context.programs();
  const std::string folder = "renderer/many_lods/";
  restart_ = &cache.compute(folder + "cut_begin.comp.glsl", {{"RESTART", "1"}});
  begin_ = &cache.compute(folder + "cut_begin.comp.glsl");
  scan_ = &cache.compute(folder + "cut_scan.comp.glsl");
  emit_ = &cache.compute(folder + "cut_emit.comp.glsl");
  for (int rule = 0; rule < kRuleCount; ++rule)
    for (const bool counting : {false, true}) {
      gl::ShaderDefines defines = {{"RULE", std::to_string(rule)}};
      if (counting) defines["COUNTING"] = "1";
      classify_.push_back(&cache.compute(folder + "cut_classify.comp.glsl", defines));
    }
  for (const gl::Program* program : {restart_, begin_, scan_, emit_}) {
    program->set("capacity", capacity_);
    program->set("leaves", leaves_);
  }
}

int64_t MultiCut::bytes() const { return list_.bytes() + codes_.bytes() + tiles_.bytes() + control_.bytes(); }

void MultiCut::step(const gl::Program& classify, uint32_t number, uint32_t last, bool always) {
  const auto run = [&](const gl::Program& program, size_t offset) {
    program.set("step_", number);
    program.set("capacity", capacity_);
    program.set("leaves", leaves_);
    program.use();
    glDispatchComputeIndirect(static_cast<GLintptr>(sizeof(CutControl) + number * sizeof(CutStep) + offset));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  };
  // By one edge, or as far as a step can.
  const int levels = always ? 1 : kSplitLevels;
  classify.set("splitLevels", levels);
  emit_->set("splitLevels", levels);
  scan_->set("lastStep", last);
  scan_->set("always", always ? 1U : 0U);
  run(classify, offsetof(CutStep, classifyX));
  run(*scan_, offsetof(CutStep, scanX));
  run(*emit_, offsetof(CutStep, emitX));
}

void MultiCut::update(const gl::Buffer& nodes, const gl::Buffer& views, bool counting) {
  const bool fromRoot = fresh_ || std::holds_alternative<BasicCuts>(mode_);
  nodes.bindStorage(kCutNodesBuffer);
  views.bindStorage(kCutViewsBuffer);
  list_.bindStorage(kCutListBuffer);
  codes_.bindStorage(kCutCodesBuffer);
  tiles_.bindStorage(kCutTilesBuffer);
  control_.bindStorage(kCutControlBuffer);
  const gl::Program& begin = fromRoot ? *restart_ : *begin_;
  begin.set("viewCount", views_);
  begin.set("capacity", capacity_);
  begin.set("leaves", leaves_);
  begin.use();
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  const uint32_t groups = fromRoot ? (views_ + kCutGroup - 1) / kCutGroup : 1U;
  glDispatchCompute(std::clamp(groups, 1U, static_cast<uint32_t>(kMostCutGroups)), 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, control_.id());
  const auto edges = [&]() -> int {
    if (const auto* lazy = std::get_if<LazyCuts>(&mode_)) return lazy->edges;
    if (const auto* literal = std::get_if<LiteralCuts>(&mode_)) return literal->edges;
    return 0;
  }();
  if (!fromRoot && edges > 0) {
    const uint32_t rule = std::holds_alternative<LazyCuts>(mode_) ? kRuleOneEdge : kRuleLiteral;
    for (uint32_t i = 0; i < static_cast<uint32_t>(edges); ++i)
      step(classifier(rule, counting), i, static_cast<uint32_t>(edges - 1), true);
  } else {
    for (uint32_t i = 0; i < fullSteps_; ++i)
      step(classifier(i == 0 && !fromRoot ? kRuleClimb : kRuleSplit, counting), i, fullSteps_ - 1, false);
  }
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
  fresh_ = false;
}

CutControl MultiCut::control() const { return control_.read<CutControl>(0, 1)[0]; }

std::vector<glm::uvec2> MultiCut::list() const {
  const CutControl state = control();
  std::vector<glm::uvec2> out =
      list_.read<glm::uvec2>(kEntryBytes * int64_t{state.readAt}, int64_t{state.count});
  for (glm::uvec2& entry : out) entry.y &= ~kEntryDone;
  return out;
}

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

CutFaults faultsOf(const std::vector<glm::uvec2>& list, uint32_t views, int depth) {
  const uint32_t leaves = 1U << depth;
  // Differences of how many nodes are above each leaf.
  std::vector<std::vector<int32_t>> steps(views);
  for (const glm::uvec2 entry : list) {
    std::vector<int32_t>& of = steps[entry.y];
    if (of.empty()) of.resize(size_t{leaves} + 1);
    const int below = depth + 1 - std::bit_width(entry.x);
    const uint32_t first = (entry.x << below) - leaves;
    ++of[first];
    --of[first + (1U << below)];
  }
  CutFaults faults;
  for (const std::vector<int32_t>& of : steps) {
    if (of.empty()) {
      faults.uncovered += leaves;
      continue;
    }
    int32_t above = 0;
    for (uint32_t leaf = 0; leaf < leaves; ++leaf) {
      above += of[leaf];
      faults.uncovered += above == 0 ? 1 : 0;
      faults.doubled += above > 1 ? 1 : 0;
    }
  }
  return faults;
}

}  // namespace limen::many_lods
