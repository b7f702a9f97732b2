// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tests/fuzz/mutation.h"

namespace limen::fuzz {

/// Changes a store in place: either flips and overwrites bytes of the file, or writes odd values into cells,
/// exchanges them, removes and repeats rows, past every constraint and trigger.
void damageStore(Random& random, const std::string& path);

/// Merges the journal into the file, so that a copy of it is whole.
void mergeJournal(const std::string& path);

}  // namespace limen::fuzz
