// SPDX-License-Identifier: BSD-3-Clause
#include "tests/study/application/study_run.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>

extern char** environ;

namespace limen::test {
namespace {

constexpr int kSilenceMs = 120'000;

pid_t start(std::vector<std::string> words, const std::string& display, int output,
            const std::string& messages) {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable; ++variable) {
    const std::string text = *variable;
    if (text.rfind("DISPLAY=", 0) != 0 && text.rfind("WAYLAND_DISPLAY=", 0) != 0) variables.push_back(text);
  }
  if (!display.empty()) variables.push_back("DISPLAY=" + display);
  std::vector<char*> arguments, environment;
  for (std::string& word : words) arguments.push_back(word.data());
  for (std::string& variable : variables) environment.push_back(variable.data());
  arguments.push_back(nullptr);
  environment.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (output >= 0) posix_spawn_file_actions_adddup2(&actions, output, 1);
  if (!messages.empty())
    posix_spawn_file_actions_addopen(&actions, 2, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t process = -1;
  const int failed =
      posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error("cannot start " + words[0]);
  return process;
}

int statusOf(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace

StudyRun::StudyRun(const std::string& display, const std::vector<std::string>& arguments,
                   std::string messageFile)
    : display_(display), messageFile_(std::move(messageFile)) {
  std::vector<std::string> words = {LIMEN_BIN_DIR "/limen-study", "run"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  output_ = ends[0];
  process_ = start(words, display, ends[1], messageFile_);
  close(ends[1]);
}

StudyRun::~StudyRun() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    statusOf(process_);
  }
  close(output_);
}

std::string StudyRun::line() {
  while (true) {
    if (const size_t end = buffer_.find('\n'); end != std::string::npos) {
      const std::string first = buffer_.substr(0, end);
      buffer_.erase(0, end + 1);
      return first;
    }
    pollfd ready{output_, POLLIN, 0};
    if (poll(&ready, 1, kSilenceMs) <= 0) throw std::runtime_error("limen-study says nothing: " + messages());
    std::array<char, 4096> bytes{};
    const ssize_t count = read(output_, bytes.data(), bytes.size());
    if (count <= 0) return "";
    buffer_.append(bytes.data(), static_cast<size_t>(count));
  }
}

bool StudyRun::reaches(const std::string& screen) {
  for (std::string next = line(); !next.empty(); next = line())
    if (next == "screen: " + screen) return true;
  return false;
}

void StudyRun::act(const std::vector<std::string>& words) const {
  std::vector<std::string> call = {"xdotool"};
  call.insert(call.end(), words.begin(), words.end());
  if (statusOf(start(call, display_, -1, "")) != 0) throw std::runtime_error("xdotool fails");
}

void StudyRun::signal(int number) const { kill(process_, number); }

int StudyRun::finish() {
  for (std::string next = line(); !next.empty(); next = line()) rest_ += next + "\n";
  const int status = statusOf(process_);
  process_ = -1;
  return status;
}

std::string StudyRun::messages() const {
  std::ostringstream text;
  text << std::ifstream(messageFile_).rdbuf();
  return text.str();
}

}  // namespace limen::test
