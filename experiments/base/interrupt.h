// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace limen {

/// Thrown from long-running work after SIGINT or SIGTERM.
struct Interrupted {};

/// From now on the first SIGINT or SIGTERM asks for an orderly end; a second one ends the process at once,
/// and so does the first one after `graceS` seconds if the process is still there: long calls into
/// libraries and drivers cannot be asked to stop. The next process therefore takes over whatever this one may
/// leave behind (claims of runs, sessions, part files). The exit code is 128 plus the signal in each case.
void installInterruptHandlers(double graceS = 0.7);

/// The signal that requested the stop, or 0.
int interruptSignal();
void throwIfInterrupted();
/// `code`, or 128 plus the signal after one.
int exitCodeAfter(int code);

/// Done, in another thread, if the process is ended after the grace period while this exists; it gets a
/// quarter of a second.
class AtForcedEnd {
 public:
  explicit AtForcedEnd(std::function<void()> action);
  ~AtForcedEnd();
  AtForcedEnd(const AtForcedEnd&) = delete;
  AtForcedEnd& operator=(const AtForcedEnd&) = delete;
};

}  // namespace limen
