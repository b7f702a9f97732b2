// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace limen::fuzz {

/// Random choices by a seed alone, the same on every machine.
class Random {
 public:
  explicit Random(uint64_t seed) : engine_(seed) {}
  /// From 0 to below `count`, or 0.
  size_t below(size_t count) { return count == 0 ? 0 : static_cast<size_t>(engine_() % count); }
  bool chance(double share) { return static_cast<double>(engine_() >> 11U) * 0x1p-53 < share; }
  template <class T>
  const T& pick(const std::vector<T>& of) {
    return of[below(of.size())];
  }

 private:
  std::mt19937_64 engine_;
};

/// Changes an input into one that nobody would write. `corpus`: valid inputs of the same kind, the source of
/// spliced parts.
using Mutate = std::string (*)(Random& random, const std::string& input,
                               const std::vector<std::string>& corpus);

/// Values that break what expects others: huge, negative and impossible numbers, other types, control
/// characters, bytes that are not UTF-8, devices, syntax of YAML, CSV and expressions.
const std::string& oddValue(Random& random);

/// Flipped, inserted, removed and repeated bytes, little- and big-endian extremes, truncation, parts of other
/// inputs.
std::string mutateBytes(Random& random, const std::string& input, const std::vector<std::string>& corpus);
/// The same for text, whose words and numbers are also replaced.
std::string mutateText(Random& random, const std::string& input, const std::vector<std::string>& corpus);
/// Cells, rows and columns of comma-separated values exchanged, removed, repeated and replaced.
std::string mutateCsv(Random& random, const std::string& input, const std::vector<std::string>& corpus);
/// Nodes of a YAML tree exchanged, removed, repeated, wrapped, replaced and taken from other inputs; one in
/// three as mutateText().
std::string mutateYaml(Random& random, const std::string& input, const std::vector<std::string>& corpus);

}  // namespace limen::fuzz
