// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace limen::analysis {

/// The different values of a column and which of them each row has.
struct Levels {
  std::vector<std::string> names;
  std::vector<size_t> ofRow;  ///< index of names
};

/// In order of first appearance. If all are numbers, growing, and numbers that are equal are one level ("1",
/// "1.0") with the first spelling as its name.
Levels levelsIn(const std::vector<std::string>& column);
/// In order of first appearance, letter by letter: for names of people.
Levels namesIn(const std::vector<std::string>& column);

}  // namespace limen::analysis
