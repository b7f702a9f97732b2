// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/compute/stream_reduction.h"

#include <cassert>

#include "renderer/compute/reduction_forms.h"

namespace limen::compute {
namespace {

ReductionForm chosenReduction(ReductionForm form, const gl::Context& context) {
  if (form != ReductionForm::Scatter) return form;
  return context.device().software ? ReductionForm::ScanScatter : ReductionForm::LookBack;
}

}  // namespace

StreamReduction::StreamReduction(gl::Context& context, uint32_t most, const ReductionSettings& settings)
    : form_(chosenReduction(settings.form, context)), most_(most), settings_(settings) {
  assert(settings.lanes == 1 || settings.lanes == 2);
  assert(most <= kMostStreamItems);
  backEnd_ = makeScatterForm(context, most, settings, form_);
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

int64_t StreamReduction::bytes() const { return backEnd_->bytes(); }
ReductionForm StreamReduction::form() const { return form_; }

}  // namespace limen::compute
