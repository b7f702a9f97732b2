// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>
#include <string>

namespace limen::test {

/// An X server of its own on a free display number, for as long as it lives. Throws std::runtime_error if
/// Xvfb cannot be started.
class XServer {
 public:
  XServer(int widthPx, int heightPx);
  ~XServer();
  XServer(const XServer&) = delete;
  XServer& operator=(const XServer&) = delete;
  /// For the environment variable DISPLAY.
  const std::string& display() const { return display_; }
  /// Ends it at once, as when a display is taken away.
  void stop();

 private:
  pid_t process_ = -1;
  std::string display_;
};

/// Lets windows of this process open on a server of 2560 x 1440 pixels that lives as long as the process: the
/// window library stays with the first server that it meets.
void openWindowsOnOneServer();

}  // namespace limen::test
