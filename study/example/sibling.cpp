// SPDX-License-Identifier: BSD-3-Clause
#include "study/example/sibling.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <optional>
#include <system_error>

#include "experiments/base/error.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/part_file.h"

namespace limen::study {
namespace {

namespace fs = std::filesystem;

/// What the child says until its end. Asked to stop, this process asks the child to.
std::string readAll(int file, pid_t child) {
  std::string out;
  std::array<char, 4096> buffer{};
  constexpr int kLookMs = 50;
  while (true) {
    if (interruptSignal() != 0) kill(child, SIGTERM);
    pollfd readable{file, POLLIN, 0};
    if (poll(&readable, 1, kLookMs) == 0) continue;
    const ssize_t got = read(file, buffer.data(), buffer.size());
    if (got > 0) out.append(buffer.data(), static_cast<size_t>(got));
    if (got == 0 || (got < 0 && errno != EINTR)) return out;
  }
}

std::string lastLine(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const size_t line = text.rfind('\n');
  return line == std::string::npos ? text : text.substr(line + 1);
}

}  // namespace

std::string siblingProgram(const std::string& name) {
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code).parent_path() / name;
  if (code || !fs::exists(program))
    throw Error("the program is not built", program.string(), "build its target, " + name);
  return program.string();
}

SiblingEnd runSibling(const std::vector<std::string>& words, const std::string& output) {
  std::optional<PartFile> part;
  if (!output.empty()) part.emplace(output);
  const std::string unfinished = part ? part->path() : "/dev/null";
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return {127, "cannot create a pipe"};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, unfinished.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0644);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  pid_t child = 0;
  const int failed = posix_spawn(&child, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  SiblingEnd end;
  if (failed != 0) {
    close(ends[0]);
    return {127, std::system_category().message(failed)};
  }
  end.message = lastLine(readAll(ends[0], child));
  close(ends[0]);
  int status = 0;
  pid_t waited = 0;
  do waited = waitpid(child, &status, 0);
  while (waited < 0 && errno == EINTR);
  end.status = waited != child ? 127 : WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  throwIfInterrupted();
  if (part && end.status == 0) part->putInPlace();
  return end;
}

}  // namespace limen::study
