// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/standard_output.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

#include "experiments/base/error.h"

namespace limen {

int afterStandardOutput(const std::string& program, int exitCode) {
  errno = 0;
  std::cout.flush();
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && !std::ferror(stdout) && std::cout.good()) return exitCode;
  std::fprintf(stderr, "%s: standard output cannot be written%s%s\n", program.c_str(), errno != 0 ? ": " : "",
               errno != 0 ? std::strerror(errno) : "");
  return exitCode == kExitSuccess ? kExitFailedRuns : exitCode;
}

}  // namespace limen
