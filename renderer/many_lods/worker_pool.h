// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace limen::many_lods {

/// Threads that wait for work, one for each core but the caller's: starting them takes longer than a frame's
/// share of a cut.
class WorkerPool {
 public:
  WorkerPool();
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// work(i) for all i below `count`, in any order, by all threads and the caller; returns when all is done.
  /// `work` throws nothing.
  void run(uint32_t count, const std::function<void(uint32_t)>& work);
  uint32_t threads() const { return static_cast<uint32_t>(threads_.size()) + 1; }

 private:
  void takePart();

  std::mutex mutex_;
  std::condition_variable start_, end_;
  uint64_t round_ = 0;
  size_t busy_ = 0;
  bool stopping_ = false;
  std::atomic<uint32_t> next_ = 0;
  uint32_t count_ = 0;
  const std::function<void(uint32_t)>* work_ = nullptr;
  std::vector<std::thread> threads_;
};

}  // namespace limen::many_lods
