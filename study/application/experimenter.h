// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "renderer/window/input.h"
#include "study/application/session_watch.h"

namespace limen::study {

/// Notes that an experimenter can take with one click: code and meaning.
using NoteCodes = std::vector<std::pair<std::string, std::string>>;

/// A second window for the experimenter: progress, timing, notes, ending the session. Drawn only while the
/// participant's window waits for input, so that it never affects a stimulus's timing.
class ExperimenterWindow {
 public:
  /// Throws Error like UiWindow.
  ExperimenterWindow(int monitor, float scale, NoteCodes codes);
  ~ExperimenterWindow();
  /// Draws and processes clicks; at most a few times a second, however often it is called.
  void tick(const SessionWatch& watch);
  /// Codes that were clicked since the last call.
  std::vector<std::string> takeNotes();
  /// Keys it received since the last call: it does not use keys, but a window manager sends them to the
  /// window clicked last, whoever is at the keyboard.
  std::vector<window::Input> takeKeys();
  /// True once after the experimenter has ended the session and confirmed it.
  bool takeAbort();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limen::study
