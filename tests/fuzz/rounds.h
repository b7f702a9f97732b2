// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/fuzz/mutation.h"

namespace limen::fuzz {

/// A reader of files under test.
struct Parser {
  std::string name;                 ///< of files that are saved
  std::string extension;            ///< with its dot
  std::vector<std::string> corpus;  ///< valid inputs
  Mutate mutate = mutateText;
  /// Reads the file and throws Error that names it, or throws Violation.
  std::function<void(const std::string& path)> read = {};
  int rounds = 500;
  double secondsPerRound = 5.0;  ///< of the processor
  /// In place of `mutate`, where an input is more than a text: makes a file by a seed.
  std::function<void(Random& random, const std::string& path)> make = {};
};

/// What `read` finds wrong with a result: a number that is not finite, say.
struct Violation {
  std::string what;
};

struct Failure {
  uint64_t seed = 0;
  std::string what;   ///< "crashed with signal 11"
  std::string saved;  ///< path of the input
};

struct Outcome {
  int read = 0, refused = 0;  ///< rounds
  std::vector<Failure> failures;
};

/// Rounds with the seeds from `firstSeed` on, in a process of their own that may use 3 GiB of memory. It ends
/// at the first five failures: a crash, a round beyond its time, an exception other than Error, one that
/// lacks the file's name, a message beyond 64 KiB.
Outcome runRounds(const Parser& parser, uint64_t firstSeed, int rounds);

/// The same as a test: seeds from LIMEN_FUZZ_SEED (default 1), LIMEN_FUZZ_ROUNDS of them (default: the
/// parser's). Some inputs must be read and some refused, or the changes are too weak or too strong to test
/// anything.
void expectRobust(const Parser& parser);

/// Contents of all files with this ending below a folder of the source tree, in the order of their names.
std::vector<std::string> shippedFiles(const std::string& folder, const std::string& extension);

}  // namespace limen::fuzz
