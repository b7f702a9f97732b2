// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace limen {

/// What a program said and how it ended.
struct ProgramRun {
  int code = -1;     ///< exit status; -1 if it did not end by itself
  std::string text;  ///< both streams
};

/// Starts one of the built programs through the shell: `call` is its name and its arguments, `environment`
/// assignments such as "LC_ALL=C".
inline ProgramRun runProgram(const std::string& call, const std::string& environment = {}) {
  ProgramRun run;
  const std::string line =
      (environment.empty() ? "" : "env " + environment + " ") + LIMEN_BIN_DIR "/" + call + " 2>&1";
  FILE* pipe = popen(line.c_str(), "r");
  if (!pipe) return run;
  std::array<char, 4096> buffer{};
  for (size_t read = 0; (read = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    run.text.append(buffer.data(), read);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) run.code = WEXITSTATUS(status);
  return run;
}

}  // namespace limen
