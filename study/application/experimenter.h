// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "renderer/window/input.h"
#include "study/application/session_watch.h"

namespace limen::study {

/// What an experimenter may note down with one click: code, and what it means.
using NoteCodes = std::vector<std::pair<std::string, std::string>>;

/// A second window for the experimenter: progress, timing, notes, an end to the session. Drawn only while the
/// participant's window waits for somebody, so that it never costs a stimulus its time.
class ExperimenterWindow {
 public:
  /// Throws Error as UiWindow.
  ExperimenterWindow(int monitor, float scale, NoteCodes codes);
  ~ExperimenterWindow();
  /// Draws and takes what was clicked; at most a few times a second however often it is called.
  void tick(const SessionWatch& watch);
  /// Codes that were clicked since the last call.
  std::vector<std::string> takeNotes();
  /// Keys that came to it since the last call: it has no use for keys, and a window manager gives them to the
  /// window that was clicked last, whoever sits at the keyboard.
  std::vector<window::Input> takeKeys();
  /// True once after the experimenter has ended the session and confirmed it.
  bool takeAbort();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limen::study
