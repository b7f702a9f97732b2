// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace limen::study {

struct SiblingEnd {
  int status = 0;       ///< exit status; 127 if it could not be started, 128 + signal if one ended it
  std::string message;  ///< its last line on standard error
};

/// Path of a program in the folder of this one. Throws Error if it does not exist.
std::string siblingProgram(const std::string& name);

/// Starts `words`, the first of which is a path, without a shell, and waits for its end. Its standard output
/// goes to the file `output`, which exists only if it ended with 0; "" discards it.
SiblingEnd runSibling(const std::vector<std::string>& words, const std::string& output = {});

}  // namespace limen::study
