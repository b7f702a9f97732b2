// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/worker_pool.h"

#include <algorithm>

namespace limen::many_lods {

WorkerPool::WorkerPool() {
  const uint32_t cores = std::max(std::thread::hardware_concurrency(), 1U);
  for (uint32_t i = 1; i < cores; ++i)
    threads_.emplace_back([this] {
      uint64_t seen = 0;
      while (true) {
        {
          std::unique_lock lock(mutex_);
          start_.wait(lock, [&] { return stopping_ || round_ != seen; });
          if (stopping_) return;
          seen = round_;
        }
        takePart();
        const std::lock_guard lock(mutex_);
        if (--busy_ == 0) end_.notify_one();
      }
    });
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  start_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerPool::takePart() {
  for (uint32_t i = next_++; i < count_; i = next_++) (*work_)(i);
}

void WorkerPool::run(uint32_t count, const std::function<void(uint32_t)>& work) {
  {
    const std::lock_guard lock(mutex_);
    work_ = &work;
    count_ = count;
    next_ = 0;
    busy_ = threads_.size();
    ++round_;
  }
  start_.notify_all();
  takePart();
  std::unique_lock lock(mutex_);
  end_.wait(lock, [&] { return busy_ == 0; });
}

}  // namespace limen::many_lods
