// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/cores.h"

#include <malloc.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <thread>

namespace limen {
namespace {

std::atomic<size_t> processesHere = 1;

/// Those that this process may run on.
size_t processors() {
  cpu_set_t set;
  // A machine with more than a set takes is not asked about.
  if (sched_getaffinity(0, sizeof set, &set) == 0) return static_cast<size_t>(CPU_COUNT(&set));
  return std::thread::hardware_concurrency();
}

}  // namespace

size_t cores() {
  // Asked once. A job of a cluster may have been given a few of a machine's processors.
  static const size_t kProcessors = processors();
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
