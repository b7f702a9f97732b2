// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace limen::test {

/// A serial port with somebody at its other end, who notes each byte and when it came (steady clock, ns).
class PseudoTerminal {
 public:
  PseudoTerminal();
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  const std::string& device() const { return device_; }
  std::vector<std::pair<int, int64_t>> received();
  /// Waits until there are as many bytes; false after two seconds.
  bool waitFor(size_t bytes);
  /// The cable is pulled.
  void hangUp();

 private:
  void listen();
  int file_ = -1, wake_[2] = {-1, -1};
  std::string device_;
  std::mutex mutex_;
  std::vector<std::pair<int, int64_t>> received_;
  std::thread listener_;
};

}  // namespace limen::test
