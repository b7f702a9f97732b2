// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/compute/stream_reduction.h"

#include <bit>
#include <cassert>

#include "renderer/compute/reduction_forms.h"

namespace limen::compute {
namespace {

ReductionForm chosenReduction(ReductionForm form, const gl::Context& context) {
  if (form != ReductionForm::Scatter) return form;
  return context.device().software ? ReductionForm::ScanScatter : ReductionForm::LookBack;
}

std::unique_ptr<StreamReduction::BackEnd> makeForm(gl::Context& context, uint32_t most,
                                                   const ReductionSettings& settings, ReductionForm form) {
  switch (form) {
    case ReductionForm::BlockSequential:
      return makeBlockSequentialForm(context, most, settings);
    case ReductionForm::Horn:
    case ReductionForm::GlobalSearch:
      return makeSearchForm(context, most, settings);
    case ReductionForm::Hierarchical:
      return makeHierarchicalForm(context, most, settings);
    case ReductionForm::GeometryShader:
      return makeGeometryShaderForm(context, most, settings);
    default:
      return makeScatterForm(context, most, settings, form);
  }
}

}  // namespace

StreamReduction::StreamReduction(gl::Context& context, uint32_t most, const ReductionSettings& settings)
    : form_(chosenReduction(settings.form, context)), most_(most), settings_(settings) {
  assert(settings.lanes == 1 || settings.lanes == 2);
  assert(std::has_single_bit(static_cast<uint32_t>(settings.blockSize)) && settings.blockSize >= 8 &&
         settings.blockSize <= kLongestBlock);
  assert(std::has_single_bit(static_cast<uint32_t>(settings.rowWidth)) &&
         settings.rowWidth >= settings.blockSize);
  assert(most <= kMostStreamItems);
  backEnd_ = makeForm(context, most, settings, form_);
}

StreamReduction::~StreamReduction() = default;
StreamReduction::StreamReduction(StreamReduction&&) noexcept = default;

void StreamReduction::run(const StreamInput& in, const StreamOutput& out) const {
  assert(in.most <= most_);
  assert(in.items.bytes() >= bytesFor(in.most, settings_.lanes));
  assert(settings_.flagged == (in.flags != nullptr));
  assert(!in.flags || in.flags->bytes() >= bytesFor(in.most, 1));
  assert(out.items.bytes() >= int64_t{out.capacity} * settings_.lanes * 4);
  assert(out.count.bytes() >= int64_t{sizeof(ReducedCount)} && out.groupSize > 0);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  backEnd_->run(in, out);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

uint32_t StreamReduction::fetches() const {
  const gl::Buffer* counted = backEnd_->fetches();
  return counted ? counted->read<uint32_t>(0, 1)[0] : 0;
}

int64_t StreamReduction::bytes() const { return backEnd_->bytes(); }
ReductionForm StreamReduction::form() const { return form_; }

}  // namespace limen::compute
