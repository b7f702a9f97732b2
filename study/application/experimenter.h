// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "study/application/session_watch.h"

namespace limen::study {

/// What an experimenter may note down with one click, coded so that no note can name a person.
const std::vector<std::string>& noteCodes();

/// Notes on their way into the session's log, which takes them with the next screen.
class NoteBox {
 public:
  /// `where`: what was on the screen.
  void add(const std::string& code, const std::string& where);
  /// "noise in the room (trial 12); ..." and empty from then on.
  std::string take();
  int waiting() const { return static_cast<int>(notes_.size()); }

 private:
  std::vector<std::string> notes_;
};

/// A second window for the experimenter: progress, timing, notes, an end to the session. Drawn only while the
/// participant's window waits for somebody, so that it never costs a stimulus its time.
class ExperimenterWindow {
 public:
  /// Throws Error as UiWindow.
  ExperimenterWindow(int monitor, float scale);
  ~ExperimenterWindow();
  /// Draws and takes what was clicked; at most a few times a second however often it is called.
  void tick(const SessionWatch& watch, NoteBox& notes);
  /// True once after the experimenter has ended the session and confirmed it.
  bool takeAbort();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limen::study
