// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/interrupt.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "experiments/base/error.h"

namespace limen {
namespace {

using std::chrono::duration;

constexpr double kLastActionS = 0.25;

std::atomic<int> receivedSignal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may touch lock-free atomics only");
std::atomic<int> wakeWatch{-1};
std::atomic<double> grace{0.0};

void handle(int signal) {
  // The next sweep takes over claims that a process leaves behind, so exiting at once loses nothing.
  if (receivedSignal.exchange(signal) != 0) _exit(128 + signal);
  constexpr char kWord[] = "\nstopping; press again to stop at once\n";
  [[maybe_unused]] ssize_t written = write(STDERR_FILENO, kWord, sizeof kWord - 1);
  written = write(wakeWatch, "", 1);
}

struct LastAction {
  std::mutex guard;
  std::function<void()> action;
};
/// Never destroyed: the thread that watches outlives main().
LastAction& lastAction() {
  static LastAction& action = *new LastAction;
  return action;
}

/// Waits for the signal in a thread of its own, gives the process its time and then ends it.
void watch(int woken) {
  char byte = 0;
  while (read(woken, &byte, 1) != 1) {
  }
  std::this_thread::sleep_for(duration<double>(grace));
  static std::atomic<bool> done{false};
  std::thread([] {
    try {
      const std::scoped_lock lock(lastAction().guard);
      if (lastAction().action) lastAction().action();
    } catch (...) {
      // What it would have tidied up is left to the next process.
    }
    done = true;
  }).detach();
  constexpr int kLooks = 50;
  for (int i = 0; i < kLooks && !done; ++i)
    std::this_thread::sleep_for(duration<double>(kLastActionS / kLooks));
  _exit(128 + receivedSignal);
}

void startWatch() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error("no pipe can be made", "signals");
  wakeWatch = ends[1];
  // The watch must not be the thread that a signal interrupts, nor hold up one that is.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread(watch, ends[0]).detach();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace

void installInterruptHandlers(double graceS) {
  grace = graceS;
  static std::once_flag once;
  std::call_once(once, startWatch);
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

int exitCodeAfter(int code) { return interruptSignal() != 0 ? 128 + interruptSignal() : code; }

AtForcedEnd::AtForcedEnd(std::function<void()> action) {
  const std::scoped_lock lock(lastAction().guard);
  lastAction().action = std::move(action);
}

AtForcedEnd::~AtForcedEnd() {
  const std::scoped_lock lock(lastAction().guard);
  lastAction().action = {};
}

}  // namespace limen
