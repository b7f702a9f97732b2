// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/cores.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

namespace limen {
namespace {

// In a process of its own: the answer is kept.
TEST(Cores, AreThoseThatTheProcessMayRunOn) {
  const pid_t child = fork();
  if (child == 0) {
    cpu_set_t before, one;
    if (sched_getaffinity(0, sizeof before, &before) != 0) _exit(100);
    CPU_ZERO(&one);
    for (int i = 0; i < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++i)
      if (CPU_ISSET(i, &before)) CPU_SET(i, &one);
    if (sched_setaffinity(0, sizeof one, &one) != 0) _exit(100);
    _exit(static_cast<int>(cores()));
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 1);
}

}  // namespace
}  // namespace limen
