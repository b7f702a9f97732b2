// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/listed_cuts.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <string>

#include "experiments/base/error.h"

namespace limen::many_lods {
namespace {

constexpr int64_t kListEntryBytes = 8;
constexpr uint32_t kRuleCount = 4;

uint32_t tilesFor(uint32_t entries) { return (entries + kCutTile - 1) / kCutTile; }

/// Edges of a lazy frame; 0 in other modes.
uint32_t edgesOf(const CutMode& mode) {
  if (const auto* lazy = std::get_if<LazyCuts>(&mode)) return static_cast<uint32_t>(lazy->edges);
  if (const auto* literal = std::get_if<LiteralCuts>(&mode)) return static_cast<uint32_t>(literal->edges);
  return 0;
}

bool isFree(const CutMode& mode) {
  if (const auto* basic = std::get_if<BasicCuts>(&mode)) return basic->order == CutOrder::Free;
  if (const auto* incremental = std::get_if<IncrementalCuts>(&mode))
    return incremental->order == CutOrder::Free;
  return false;
}

bool hasMargins(const CutMode& mode, const TreeShape& shape) {
  const auto* incremental = std::get_if<IncrementalCuts>(&mode);
  return incremental && incremental->margins && shape.travel;
}

/// A whole number of nodes' levels.
uint32_t splitLevelsOf(const CutMode& mode) {
  const int arityBits = arityBitsOf(mode);
  int levels = BasicCuts{}.stepLevels;
  if (const auto* basic = std::get_if<BasicCuts>(&mode)) levels = basic->stepLevels;
  if (const auto* incremental = std::get_if<IncrementalCuts>(&mode)) levels = incremental->stepLevels;
  return static_cast<uint32_t>(std::max(levels - levels % arityBits, arityBits));
}

}  // namespace

gl::Buffer cutStorage(int64_t bytes) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  if (bytes > most)
    throw Error("the lists of cuts take " + std::to_string(bytes) +
                    " bytes in one buffer; this device allows " + std::to_string(most),
                {}, "lower 'room', the number of views, or the size of the picture");
  return {bytes, nullptr};
}

ListedCuts::ListedCuts(gl::Context& context, uint32_t views, const TreeShape& shape, uint32_t capacity,
                       const CutMode& mode)
    : mode_(mode),
      shape_(shape),
      viewCount_(views),
      capacity_(capacity),
      arityBits_(static_cast<uint32_t>(arityBitsOf(mode))),
      ordered_(edgesOf(mode) > 0),
      free_(isFree(mode)),
      margins_(hasMargins(mode, shape)),
      splitLevels_(splitLevelsOf(mode)),
      // Leaves of a tree that is not complete are left over as well.
      fullSteps_(std::max((static_cast<uint32_t>(shape.height) + splitLevels_ - 1) / splitLevels_, 1U) +
                 (shape.links ? 1U : 0U)),
      list_(cutStorage((ordered_ ? 2 : 3) * kListEntryBytes * capacity)),
      codes_(cutStorage(free_ ? 0 : 4 * int64_t{kCutTile} * tilesFor(capacity))),
      tiles_(free_ ? 0 : 16 * int64_t{tilesFor(capacity)}, nullptr),
      control_(sizeof(CutControl) + kMostCutSteps * int64_t{sizeof(CutStep)}, nullptr),
      marginList_(cutStorage(margins_ ? 3 * int64_t{4} * capacity : 0)),
      lastViews_(std::vector<LastView>(margins_ ? views : 0)),
      motions_(margins_ ? 8 * int64_t{views} : 0, nullptr) {
  gl::ProgramCache& cache = context.programs();
  const std::string folder = "renderer/many_lods/";
  gl::ShaderDefines defines;
  if (shape_.links) defines["LINKED"] = "1";
  if (ordered_) defines["ORDERED"] = "1";
  if (margins_) {
    defines["MARGINS"] = "1";
    motion_ = &cache.compute(folder + "cut_motion.comp.glsl");
  }
  gl::ShaderDefines restarting = defines;
  restarting["RESTART"] = "1";
  restart_ = &cache.compute(folder + "cut_begin.comp.glsl", restarting);
  begin_ = &cache.compute(folder + "cut_begin.comp.glsl", defines);
  scan_ = &cache.compute(folder + "cut_scan.comp.glsl", defines);
  emit_ = &cache.compute(folder + "cut_emit.comp.glsl", defines);
  for (uint32_t rule = 0; rule < kRuleCount; ++rule)
    for (const bool counting : {false, true}) {
      // Those that the mode has no use for are not compiled.
      const bool lazy = rule == kRuleOneEdge || rule == kRuleLiteral;
      if (rule != kRuleSplit && lazy != ordered_) {
        classify_.push_back(nullptr);
        continue;
      }
      gl::ShaderDefines own = defines;
      own["RULE"] = std::to_string(rule);
      if (counting) own["COUNTING"] = "1";
      if (free_ && rule == kRuleClimb) own["SPLITS_LATER"] = "1";
      classify_.push_back(
          &cache.compute(folder + (free_ ? "cut_step.comp.glsl" : "cut_classify.comp.glsl"), own));
    }
}

int64_t ListedCuts::bytes() const {
  return list_.bytes() + codes_.bytes() + tiles_.bytes() + control_.bytes() + marginList_.bytes() +
         lastViews_.bytes() + motions_.bytes();
}

void ListedCuts::setShape(const gl::Program& program) const {
  program.set("capacity", capacity_);
  program.set("leaves", 1U << shape_.height % 32);
  program.set("arityBits", arityBits_);
}

void ListedCuts::dispatch(const gl::Program& program, uint32_t number, size_t offset) const {
  program.set("step_", number);
  setShape(program);
  program.use();
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, control_.id());
  glDispatchComputeIndirect(static_cast<GLintptr>(sizeof(CutControl) + number * sizeof(CutStep) + offset));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

const gl::Program& ListedCuts::configure(uint32_t rule, uint32_t last, bool counting) const {
  const gl::Program& classify = *classify_[2 * rule + counting];
  // By one edge, or as far as a step can.
  const bool oneEdge = rule == kRuleOneEdge || rule == kRuleLiteral;
  const uint32_t levels = oneEdge ? arityBits_ : splitLevels_;
  classify.set("splitLevels", levels);
  emit_->set("splitLevels", levels);
  scan_->set("always", oneEdge ? 1U : 0U);
  for (const gl::Program* program : {scan_, &classify}) {
    program->set("splitsEach", (1U << arityBits_) - 1U);
    program->set("lastStep", last);
  }
  return classify;
}

void ListedCuts::step(uint32_t rule, uint32_t number, uint32_t last, bool counting) {
  dispatch(configure(rule, last, counting), number, offsetof(CutStep, classifyX));
  if (free_) return;
  dispatch(*scan_, number, offsetof(CutStep, scanX));
  dispatch(*emit_, number, offsetof(CutStep, emitX));
}

void ListedCuts::findMotions() const {
  lastViews_.bindStorage(kMotionLastViewsBuffer);
  shape_.travel->bindStorage(kMotionTravelBuffer);
  motions_.bindStorage(kCutMotionsBuffer);
  marginList_.bindStorage(kCutMarginsBuffer);
  motion_->set("viewCount", viewCount_);
  motion_->use();
  glDispatchCompute((viewCount_ + kCutGroup - 1) / kCutGroup, 1, 1);
}

void ListedCuts::begin(const gl::Buffer& nodes, const gl::Buffer& views, bool fromRoot) {
  nodes.bindStorage(kCutNodesBuffer);
  views.bindStorage(kCutViewsBuffer);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  if (margins_) findMotions();
  list_.bindStorage(kCutListBuffer);
  codes_.bindStorage(kCutCodesBuffer);
  tiles_.bindStorage(kCutTilesBuffer);
  control_.bindStorage(kCutControlBuffer);
  if (shape_.links) shape_.links->bindStorage(kCutLinksBuffer);
  const gl::Program& program = fromRoot ? *restart_ : *begin_;
  program.set("viewCount", viewCount_);
  program.set("regions", ordered_ ? 2U : 3U);
  const int rows = !free_ ? kCutRows : fromRoot ? kSplitRows : kKeepRows;
  program.set("tile", static_cast<uint32_t>(kCutGroup * rows));
  setShape(program);
  program.use();
  const uint32_t groups = fromRoot ? (viewCount_ + kCutGroup - 1) / kCutGroup : 1U;
  glDispatchCompute(std::clamp(groups, 1U, static_cast<uint32_t>(kMostCutGroups)), 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void ListedCuts::end() {
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
  fresh_ = false;
}

void ListedCuts::update(const gl::Buffer& nodes, const gl::Buffer& views, bool counting) {
  const bool fromRoot = fresh_ || std::holds_alternative<BasicCuts>(mode_);
  begin(nodes, views, fromRoot);
  if (const uint32_t edges = edgesOf(mode_); !fromRoot && edges > 0) {
    const uint32_t rule = std::holds_alternative<LazyCuts>(mode_) ? kRuleOneEdge : kRuleLiteral;
    for (uint32_t i = 0; i < edges; ++i) step(rule, i, edges - 1, counting);
  } else {
    const uint32_t steps = fullSteps_ + (free_ && !fromRoot ? 1U : 0U);
    for (uint32_t i = 0; i < steps; ++i)
      step(i == 0 && !fromRoot ? kRuleClimb : kRuleSplit, i, steps - 1, counting);
  }
  end();
}

}  // namespace limen::many_lods
