// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <functional>
#include <string>

namespace limen {

/// As long as it lives no file of this process may grow beyond `bytes`: to whoever writes it looks like a
/// full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
};

/// Runs `work` in a child none of whose files may grow beyond `bytes`: to whoever writes it looks like a full
/// disk. The message of what it throws goes to `messageFile`. Exit status: 0, or 1 if it throws.
inline int onFullDisk(rlim_t bytes, const std::string& messageFile, const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      work();
      _exit(0);
    } catch (const std::exception& error) {
      if (FILE* const file = fopen(messageFile.c_str(), "w")) {
        fputs(error.what(), file);
        fclose(file);
      }
      _exit(1);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// The same for a program that runProgram() starts: to be given as its environment. `blocks` are of 512
/// bytes.
inline std::string fullDiskAfter(int blocks) {
  return "sh -c 'trap \"\" XFSZ; ulimit -f " + std::to_string(blocks) + "; exec \"$0\" \"$@\"'";
}

}  // namespace limen
