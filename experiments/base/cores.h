// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace limen {

/// Threads that work which uses all cores should run on: this process's share of the processors, at least 1.
size_t cores();

/// This process is one of several alike that share the machine, as tasks of one sweep on its GPUs do.
void shareCores(int processes);

/// Keeps memory that is freed for later use (up to 32 MiB a block): a bench allocates images of the same
/// sizes run after run, and each page that the system takes back costs a fault when it is next used.
void keepFreedMemory();

}  // namespace limen
