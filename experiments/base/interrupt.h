// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limen {

/// Thrown out of long work after SIGINT or SIGTERM.
struct Interrupted {};

/// From now on the first SIGINT or SIGTERM asks for an orderly end; a second one ends the process at once.
void installInterruptHandlers();

/// The signal that asked for an end, or 0.
int interruptSignal();
void throwIfInterrupted();

}  // namespace limen
