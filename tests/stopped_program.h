// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace limen {

struct StoppedRun {
  int code = -1;         ///< as a shell gives it: exit status, or 128 plus the signal that ended it
  double seconds = 0.0;  ///< from the signal to the end
  std::string text;      ///< both streams
};

/// Starts one of the built programs in `folder`, sends it `signal` once `ready` holds (it is asked again and
/// again, for a minute at most), and waits for its end, which SIGKILL brings about after another minute.
inline StoppedRun stopProgram(const std::vector<std::string>& words, const std::string& folder, int signal,
                              const std::function<bool()>& ready) {
  using Clock = std::chrono::steady_clock;
  const std::string log = folder + "/stopped.txt", program = LIMEN_BIN_DIR "/" + words.front();
  std::vector<char*> raw;
  for (const std::string& word : words) raw.push_back(const_cast<char*>(word.c_str()));
  raw.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    if (chdir(folder.c_str()) == 0) execv(program.c_str(), raw.data());
    _exit(127);
  }
  for (int i = 0; i < 600 && !ready(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const auto sent = Clock::now();
  kill(child, signal);
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (Clock::now() - sent > std::chrono::minutes(1)) kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  StoppedRun run;
  run.seconds = std::chrono::duration<double>(Clock::now() - sent).count();
  run.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  std::ifstream stream(log);
  run.text.assign(std::istreambuf_iterator<char>(stream), {});
  return run;
}

}  // namespace limen
