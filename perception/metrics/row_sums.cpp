// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/row_sums.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "experiments/base/cores.h"

namespace limen::perception {

void forEachRow(int rows, size_t pixelsPerRow, const std::function<void(int)>& work) {
  // Starting a thread costs about as much as ten thousand pixels, and they are started one after the other.
  constexpr size_t kPixelsPerThread = 65536;
  const size_t worthwhile = 1 + static_cast<size_t>(std::max(rows, 0)) * pixelsPerRow / kPixelsPerThread;
  const size_t threadCount = std::min({worthwhile, cores(), static_cast<size_t>(std::max(rows, 1))});
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex failureMutex;
  const auto run = [&] {
    try {
      for (int row = next++; row < rows; row = next++) work(row);
    } catch (...) {
      const std::lock_guard lock(failureMutex);
      if (!failure) failure = std::current_exception();
      next = rows;
    }
  };
  std::vector<std::thread> threads;
  for (size_t i = 1; i < threadCount; ++i) threads.emplace_back(run);
  run();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

double sumRows(int rows, size_t pixelsPerRow, const std::function<double(int)>& rowSum) {
  std::vector<double> sums(static_cast<size_t>(std::max(rows, 0)));
  forEachRow(rows, pixelsPerRow, [&](int row) { sums[static_cast<size_t>(row)] = rowSum(row); });
  CompensatedSum total;
  for (const double sum : sums) total.add(sum);
  return total.value();
}

}  // namespace limen::perception
