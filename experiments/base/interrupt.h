// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limen {

/// Thrown from long-running work after SIGINT or SIGTERM.
struct Interrupted {};

/// From now on the first SIGINT or SIGTERM requests an orderly stop; a second one ends the process at once.
void installInterruptHandlers();

/// The signal that requested the stop, or 0.
int interruptSignal();
void throwIfInterrupted();

}  // namespace limen
