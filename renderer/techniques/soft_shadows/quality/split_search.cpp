// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/split_search.h"

#include <epoxy/gl.h>

#include <cassert>
#include <vector>

#include "renderer/techniques/soft_shadows/quality/quality_bindings.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

namespace limen::techniques {
namespace {

/// Groups in a row of an indirect dispatch: a dimension has at most 65,535 of them, hence rows; up to one row
/// minus one group is idle.
constexpr uint32_t kGroupsPerRow = 64;

gl::Buffer emptyHeader(int lanes) {
  return gl::Buffer(std::vector{WorkListHeader{kGroupsPerRow, 0, static_cast<uint32_t>(lanes), 0}});
}

gl::Format levelFormat(bool smooths) { return smooths ? gl::Format::RG32F : gl::Format::R32F; }

}  // namespace

SplitSearch::SplitSearch(frame::Frame& frame, bool smooths, bool orders, int lanes, int layers)
    : areas_(gl::Format::RGBA16UI, frame.sizePx(), 1, layers > 1 ? layers : 0),
      levels_(levelFormat(smooths), frame.sizePx(), 1, layers > 1 ? layers : 0),
      headers_{emptyHeader(lanes), emptyHeader(lanes)},
      work_(int64_t{4} * frame.sizePx().x * frame.sizePx().y, nullptr) {
  assert(layers == 1 || !smooths);
  if (layers > 1) {
    firstAreas_.emplace(areas_.view(0));
    firstLevels_.emplace(levels_.view(0));
  }
  if (smooths) halfSmoothed_.emplace(levelFormat(smooths), frame.sizePx());
  if (orders) {
    const std::vector<uint32_t> none(size_t{2} * kWorkBins, 0);
    order_.emplace(Order{gl::Buffer(work_.bytes(), nullptr), gl::Buffer(none), gl::Buffer(none)});
  }
}

int64_t SplitSearch::bytes() const {
  return areas_.bytes() + levels_.bytes() + (halfSmoothed_ ? halfSmoothed_->bytes() : 0) + work_.bytes() +
         headers_[0].bytes() + headers_[1].bytes() +
         (order_ ? order_->list.bytes() + order_->bins.bytes() + order_->emptyBins.bytes() : 0);
}

void SplitSearch::bindForClassify() {
  current_ = 1 - current_;
  header().bindStorage(kWorkHeaderBuffer);
  headers_[1 - current_].bindStorage(kNextWorkHeaderBuffer);
  areas_.bindImage(kSplitAreasImage, gl::Access::Write);
  levels_.bindImage(kSplitLevelsImage, gl::Access::Write);
  if (halfSmoothed_) halfSmoothed_->bindImage(kSplitHalfSmoothedImage, gl::Access::Write);
  work_.bindStorage(kWorkListBuffer);
}

void SplitSearch::bindForGather() const {
  areas_.bindTexture(kSplitSearchAreasUnit);
  levels_.bindTexture(kSplitLevelMapUnit);
  header().bindStorage(kWorkHeaderBuffer);
  (order_ ? order_->list : work_).bindStorage(kWorkListBuffer);
}

void SplitSearch::dispatchOverList(const gl::Program& program) const {
  program.use();
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, header().id());
  glDispatchComputeIndirect(0);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

void SplitSearch::smooth(const gl::Program& program) const {
  header().bindStorage(kWorkHeaderBuffer);
  work_.bindStorage(kWorkListBuffer);
  program.set("sizePx", levels_.sizePx());
  const auto along = [&](glm::ivec2 axis, const gl::Texture& from, const gl::Texture& to) {
    program.set("axis", axis);
    from.bindTexture(kSplitLevelMapUnit);
    to.bindImage(kSmoothLevelsImage, gl::Access::Write);
    dispatchOverList(program);
    makeVisible();
  };
  along({1, 0}, levels_, *halfSmoothed_);
  along({0, 1}, *halfSmoothed_, levels_);
}

void SplitSearch::order(const gl::Program& count, const gl::Program& scatter) const {
  glCopyNamedBufferSubData(order_->emptyBins.id(), order_->bins.id(), 0, 0, order_->bins.bytes());
  areas_.bindTexture(kSplitSearchAreasUnit);
  levels_.bindTexture(kSplitLevelMapUnit);
  header().bindStorage(kWorkHeaderBuffer);
  work_.bindStorage(kWorkListBuffer);
  order_->list.bindStorage(kOrderWorkOrderedListBuffer);
  order_->bins.bindStorage(kOrderWorkBinsBuffer);
  for (const gl::Program* program : {&count, &scatter}) {
    dispatchOverList(*program);
    makeVisible();
  }
}

void SplitSearch::makeVisible() {
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                  GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace limen::techniques
