// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/shares.h"

#include <algorithm>

namespace limen::experiments {

std::vector<Batch> batchesOf(const Plan& plan, const std::vector<size_t>& left) {
  std::vector<Batch> out;
  size_t next = 0;
  for (const auto& [begin, end] : plan.groups) {
    for (bool first = true; next < left.size() && left[next] < end; ++next, first = false) {
      const auto full = static_cast<size_t>(std::max(1, plan.runs[left[next]].timing.batch));
      if (first || out.back().size() == full) out.emplace_back();
      out.back().push_back(left[next]);
    }
  }
  return out;
}

std::vector<std::vector<size_t>> deal(size_t batches, size_t count) {
  std::vector<std::vector<size_t>> out(count);
  for (size_t i = 0; i < batches; ++i) {
    const size_t round = i / count, place = i % count;
    out[round % 2 == 0 ? place : count - 1 - place].push_back(i);
  }
  return out;
}

}  // namespace limen::experiments
