// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen {

/// A text as gnuplot's single-quoted string; control characters become blanks.
std::string gnuplotQuoted(const std::string& text);

/// Runs a script that lies in `folder`, with that as its working folder. Throws Error: gnuplot is missing
/// (with the package to install) or fails (with what it said).
void runGnuplot(const std::string& folder, const std::string& file);

}  // namespace limen
