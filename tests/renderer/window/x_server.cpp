// SPDX-License-Identifier: BSD-3-Clause
#include "tests/renderer/window/x_server.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

extern char** environ;

namespace limen::test {

XServer::XServer(int widthPx, int heightPx) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  // The server picks a free number by itself and writes it there.
  posix_spawn_file_actions_adddup2(&actions, ends[1], 3);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  std::string screen = std::to_string(widthPx) + "x" + std::to_string(heightPx) + "x24";
  std::array<std::string, 9> words = {"Xvfb", "-displayfd", "3",   "-screen", "0",
                                      screen, "-nolisten",  "tcp", "-noreset"};
  std::array<char*, 10> arguments{};
  for (size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
  const int failed = posix_spawnp(&process_, "Xvfb", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::string number;
  pollfd ready{ends[0], POLLIN, 0};
  char character = 0;
  while (failed == 0 && poll(&ready, 1, 60'000) > 0 && read(ends[0], &character, 1) == 1 && character != '\n')
    number += character;
  close(ends[0]);
  if (failed != 0 || number.empty()) {
    stop();
    throw std::runtime_error("Xvfb does not start");
  }
  display_ = ":" + number;
}

XServer::~XServer() { stop(); }

void XServer::stop() {
  if (process_ <= 0) return;
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  process_ = -1;
}

void openWindowsOnOneServer() {
  static const XServer kServer(2560, 1440);
  setenv("DISPLAY", kServer.display().c_str(), 1);
  unsetenv("WAYLAND_DISPLAY");
}

}  // namespace limen::test
