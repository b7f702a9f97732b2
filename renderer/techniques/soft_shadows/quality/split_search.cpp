// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/split_search.h"

#include <epoxy/gl.h>

#include <vector>

namespace limen::techniques {
namespace {

constexpr uint32_t kAreaUnit = 13, kLevelUnit = 14, kAreaImage = 3, kLevelImage = 4, kHalfSmoothedImage = 5;
constexpr uint32_t kBinsBinding = 5, kOrderedBinding = 6, kWorkBinding = 7;
constexpr size_t kOrderBins = 64;  ///< as in order_work.comp.glsl
/// Groups of 64 in a row of an indirect dispatch: a dimension has at most 65,535 of them, hence rows; up to
/// one row minus one group is idle.
constexpr uint32_t kGroupsPerRow = 64;

gl::Format levelFormat(bool smooths) { return smooths ? gl::Format::RG32F : gl::Format::R32F; }

}  // namespace

SplitSearch::SplitSearch(frame::Frame& frame, bool smooths, bool orders)
    : areas_(gl::Format::RGBA16UI, frame.sizePx()),
      levels_(levelFormat(smooths), frame.sizePx()),
      emptyHeader_(std::vector<uint32_t>{kGroupsPerRow, 0, 1, 0}),
      work_(16 + int64_t{4} * frame.sizePx().x * frame.sizePx().y, nullptr) {
  if (smooths) halfSmoothed_.emplace(levelFormat(smooths), frame.sizePx());
  if (orders) {
    const std::vector<uint32_t> none(2 * kOrderBins, 0);
    order_.emplace(Order{gl::Buffer(work_.bytes(), nullptr), gl::Buffer(none), gl::Buffer(none)});
  }
}

int64_t SplitSearch::bytes() const {
  return areas_.bytes() + levels_.bytes() + (halfSmoothed_ ? halfSmoothed_->bytes() : 0) + work_.bytes() +
         emptyHeader_.bytes() +
         (order_ ? order_->list.bytes() + order_->bins.bytes() + order_->emptyBins.bytes() : 0);
}

void SplitSearch::bindForClassify() const {
  glCopyNamedBufferSubData(emptyHeader_.id(), work_.id(), 0, 0, emptyHeader_.bytes());
  areas_.bindImage(kAreaImage, gl::Access::Write);
  levels_.bindImage(kLevelImage, gl::Access::Write);
  if (halfSmoothed_) halfSmoothed_->bindImage(kHalfSmoothedImage, gl::Access::Write);
  work_.bindStorage(kWorkBinding);
}

void SplitSearch::bindForGather() const {
  areas_.bindTexture(kAreaUnit);
  levels_.bindTexture(kLevelUnit);
  (order_ ? order_->list : work_).bindStorage(kWorkBinding);
}

void SplitSearch::dispatchOverList(const gl::Program& program) const {
  dispatch(program, order_ ? order_->list : work_);
}

void SplitSearch::dispatch(const gl::Program& program, const gl::Buffer& list) const {
  program.use();
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, list.id());
  glDispatchComputeIndirect(0);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

void SplitSearch::smooth(const gl::Program& program) const {
  work_.bindStorage(kWorkBinding);
  program.set("sizePx", levels_.sizePx());
  const auto along = [&](glm::ivec2 axis, const gl::Texture& from, const gl::Texture& to) {
    program.set("axis", axis);
    from.bindTexture(kLevelUnit);
    to.bindImage(0, gl::Access::Write);
    dispatch(program, work_);
    makeVisible();
  };
  along({1, 0}, levels_, *halfSmoothed_);
  along({0, 1}, *halfSmoothed_, levels_);
}

void SplitSearch::order(const gl::Program& count, const gl::Program& scatter) const {
  glCopyNamedBufferSubData(order_->emptyBins.id(), order_->bins.id(), 0, 0, order_->bins.bytes());
  areas_.bindTexture(kAreaUnit);
  levels_.bindTexture(kLevelUnit);
  work_.bindStorage(kWorkBinding);
  order_->list.bindStorage(kOrderedBinding);
  order_->bins.bindStorage(kBinsBinding);
  for (const gl::Program* program : {&count, &scatter}) {
    dispatch(*program, work_);
    makeVisible();
  }
}

void SplitSearch::makeVisible() {
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                  GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace limen::techniques
