// SPDX-License-Identifier: BSD-3-Clause
#include "perception/multiscale/plane.h"

#include <algorithm>
#include <exception>
#include <thread>

#include "experiments/base/cores.h"

namespace limen::perception {

void forRowBlocks(int rows, size_t costPerRow, const std::function<void(int, int)>& work) {
  if (rows <= 0) return;
  // Starting a thread costs about as much as some ten thousand multiplications.
  constexpr size_t kCostPerThread = 65536;
  const size_t worthwhile = 1 + static_cast<size_t>(rows) * costPerRow / kCostPerThread;
  const int count = static_cast<int>(std::min({worthwhile, cores(), static_cast<size_t>(rows)}));
  const auto bound = [&](int i) { return static_cast<int>(int64_t{rows} * i / count); };
  std::vector<std::exception_ptr> failures(static_cast<size_t>(count));
  const auto run = [&](int i) {
    try {
      work(bound(i), bound(i + 1));
    } catch (...) {
      failures[static_cast<size_t>(i)] = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < count; ++i) threads.emplace_back(run, i);
  run(0);
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace limen::perception
