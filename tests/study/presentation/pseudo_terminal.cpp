// SPDX-License-Identifier: BSD-3-Clause
#include "tests/study/presentation/pseudo_terminal.h"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <stdexcept>

namespace limen::test {
namespace {

int64_t nowNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

PseudoTerminal::PseudoTerminal() {
  file_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (file_ < 0 || grantpt(file_) != 0 || unlockpt(file_) != 0 || pipe2(wake_, O_CLOEXEC) != 0)
    throw std::runtime_error("no pseudo-terminal");
  std::array<char, 256> name{};
  if (ptsname_r(file_, name.data(), name.size()) != 0)
    throw std::runtime_error("a pseudo-terminal without name");
  device_ = name.data();
  listener_ = std::thread([this] { listen(); });
}

PseudoTerminal::~PseudoTerminal() {
  hangUp();
  close(wake_[0]);
  close(wake_[1]);
}

void PseudoTerminal::hangUp() {
  if (!listener_.joinable()) return;
  const char byte = 0;
  if (write(wake_[1], &byte, 1) != 1) return;
  listener_.join();
  close(file_);
}

void PseudoTerminal::listen() {
  while (true) {
    // Until somebody opens it, and after they closed it, reading fails at once: look again in a moment.
    pollfd ready[2] = {{wake_[0], POLLIN, 0}, {file_, POLLIN, 0}};
    poll(ready, 2, 100);
    if (ready[0].revents != 0) return;
    unsigned char byte = 0;
    if ((ready[1].revents & POLLIN) != 0 && read(file_, &byte, 1) == 1) {
      const std::lock_guard lock(mutex_);
      received_.emplace_back(byte, nowNs());
    } else if ((ready[1].revents & POLLHUP) != 0) {
      usleep(1000);
    }
  }
}

std::vector<std::pair<int, int64_t>> PseudoTerminal::received() {
  const std::lock_guard lock(mutex_);
  return received_;
}

bool PseudoTerminal::waitFor(size_t bytes) {
  for (int i = 0; i < 2000 && received().size() < bytes; ++i) usleep(1000);
  return received().size() >= bytes;
}

}  // namespace limen::test
