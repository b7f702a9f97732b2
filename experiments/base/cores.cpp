// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/cores.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <thread>

namespace limen {
namespace {

std::atomic<size_t> processesHere = 1;

}  // namespace

size_t cores() {
  // Asked once: the answer is read from files.
  static const size_t kProcessors = std::thread::hardware_concurrency();
  return std::max<size_t>(kProcessors / processesHere, 1);
}

void shareCores(int processes) { processesHere = static_cast<size_t>(std::max(processes, 1)); }

void keepFreedMemory() {
  constexpr int kLargestBlock = 32 << 20;  // the most that glibc takes
  constexpr int kKept = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, kLargestBlock);
  mallopt(M_TRIM_THRESHOLD, kKept);
  mallopt(M_TOP_PAD, 64 << 20);
}

}  // namespace limen
