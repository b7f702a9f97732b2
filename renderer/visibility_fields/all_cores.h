// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

#include "experiments/base/cores.h"

namespace limen::visibility_fields {

/// Calls work(i) for every i in [0, count) on all cores. `work` must not throw, and treats every number by
/// itself, so that results do not depend on the number of cores.
template <class Work>
void onAllCores(size_t count, const Work& work) {
  const size_t threads = cores();
  const auto run = [&](size_t thread) {
    for (size_t i = thread; i < count; i += threads) work(i);
  };
  std::vector<std::jthread> helpers;
  for (size_t thread = 1; thread < threads; ++thread) helpers.emplace_back(run, thread);
  run(0);
}

}  // namespace limen::visibility_fields
