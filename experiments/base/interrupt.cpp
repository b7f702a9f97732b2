// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>

namespace limen {
namespace {

std::atomic<int> receivedSignal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may touch lock-free atomics only");

void handle(int signal) {
  // The next sweep takes over claims that a process leaves behind, so exiting at once loses nothing.
  if (receivedSignal.exchange(signal) != 0) _exit(128 + signal);
  constexpr char kWord[] = "\nstopping; press again to stop at once\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kWord, sizeof kWord - 1);
}

}  // namespace

void installInterruptHandlers() {
  struct sigaction action {};
  action.sa_handler = handle;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int interruptSignal() { return receivedSignal; }

void throwIfInterrupted() {
  if (interruptSignal() != 0) throw Interrupted{};
}

}  // namespace limen
