// SPDX-License-Identifier: BSD-3-Clause
// What a traversal counted, and what later frames take from it.
#include <algorithm>

#include "renderer/techniques/reflections/ray_hierarchy/pair_traversal.h"

namespace limen::techniques {

int64_t PairTraversal::bytes() const {
  int64_t bytes = nodes_->bytes() + control_->bytes() + left_->bytes() + hits_.bytes();
  for (const auto& stream : streams_) bytes += stream->bytes();
  if (gathered_) bytes += gathered_->bytes();
  for (const auto& waiting : waiting_)
    if (waiting) bytes += waiting->bytes();
  if (separate()) bytes += sparse_->bytes() + reduced_->bytes() + reduction_->bytes();
  return bytes;
}

void PairTraversal::endFrame() {
  if (std::holds_alternative<HalvedBatches>(settings_.overflow)) readback_.copy(*control_, batches_.size());
}

void PairTraversal::halveBatches() {
  uint64_t tag = 0;
  const auto* control = static_cast<const HierarchyControl*>(readback_.take(tag));
  if (!control || tag != batches_.size() || control->leftEver == 0) return;
  std::vector<Batch> out;
  auto more = static_cast<int64_t>(mostBatches_) - static_cast<int64_t>(batches_.size());
  for (size_t i = 0; i < batches_.size(); ++i) {
    const Batch& batch = batches_[i];
    if (control->batchLeft[i] == 0 || batch.count < 2 || more <= 0) {
      out.push_back(batch);
      continue;
    }
    --more;
    const uint32_t half = batch.count / 2;
    out.push_back({batch.first, half});
    out.push_back({batch.first + half, batch.count - half});
  }
  batches_ = std::move(out);
}

std::vector<glm::uvec2> PairTraversal::lastPairs() const {
  const HierarchyControl control = control_->read<HierarchyControl>(0, 1)[0];
  return streams_[reading_]->read<glm::uvec2>(0, control.inputs);
}

PairTraversal::Counts PairTraversal::counts() const {
  Counts out;
  out.control = control_->read<HierarchyControl>(0, 1)[0];
  out.tests = testsOfFrame_;
  for (uint32_t level = leafLevel_ + 1; level <= startLevel_; ++level)
    out.tests += 4 * uint64_t{out.control.pairsAt[level]};
  out.batches = static_cast<int>(batches_.size());
  return out;
}

}  // namespace limen::techniques
