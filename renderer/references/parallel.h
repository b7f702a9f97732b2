// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

#include "experiments/base/cancel.h"
#include "experiments/base/cores.h"

namespace limen::references {

/// Calls work(thread, first, last) for pieces that cover [0, count) on all cores. The pieces of a thread
/// depend only on `count` and the number of cores; if work treats every index independently, results do not
/// depend even on that. `work` must not throw. Ends early if the calling thread's work is cancelled (see
/// experiments/base/cancel.h): then some pieces are missing.
template <class Work>
void parallelFor(size_t count, const Work& work) {
  constexpr size_t kPiece = 16;  // small: costs differ widely between lit pixels and penumbrae
  const size_t threads = cores();
  const std::stop_token cancelled = cancelToken();
  const auto run = [&](size_t thread) {
    for (size_t first = thread * kPiece; first < count && !cancelled.stop_requested();
         first += threads * kPiece)
      work(thread, first, std::min(first + kPiece, count));
  };
  std::vector<std::jthread> helpers;
  for (size_t thread = 1; thread < threads; ++thread) helpers.emplace_back(run, thread);
  run(0);
}

}  // namespace limen::references
