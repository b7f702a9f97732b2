// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "study/session/session.h"

namespace limen::study {

/// A frame as it was shown.
struct ShownFrame {
  int stimulus = 0, showing = 0,
      frame = 0;         ///< which of the trial's stimuli, which presentation, which frame of it
  int64_t swapNs = 0;    ///< steady clock when the swap returned
  int missedBlanks = 0;  ///< vertical blanks for which its predecessor stayed on too long
};

/// A byte sent to a recorder.
struct SentMarker {
  MarkerKind kind = MarkerKind::Stimulus;
  int code = 0;
  int64_t dueNs = 0;   ///< steady clock when it happened: of a frame, when its swap returned
  int64_t sentNs = 0;  ///< steady clock when the system had taken the byte
};

struct Answer {
  std::string answer;                       ///< one of TaskSetting::answers
  std::optional<int> severity, confidence;  ///< steps from 1
  double reactionTimeS = 0.0;  ///< from the end of the last stimulus (or the question, whichever is later)
  int64_t questionNs = 0, answeredNs = 0;           ///< steady clock
  std::string device;                               ///< "keyboard", "mouse", "gamepad", "observer"
  nlohmann::json extra = nlohmann::json::object();  ///< e.g. a simulated observer's probability
};

enum class Outcome { Done, Invalid, Paused, Aborted };

struct ScreenResult {
  Outcome outcome = Outcome::Done;
  nlohmann::json answers = nlohmann::json::object();  ///< Form: field -> choice; Consent: {"consent": true}
  std::string note;  ///< free text from the form; goes through the privacy filter
  std::string by =
      "participant";   ///< who asked for Paused or Aborted: "participant", "experimenter", "system"
  std::string reason;  ///< why Paused or Aborted, if there is anything to say
};

struct TrialResult {
  Outcome outcome = Outcome::Done;
  std::string reason;  ///< why Invalid: "2 missed frames", "window lost", "answered during the blank"
  std::vector<ShownFrame> frames;
  std::vector<SentMarker> markers;
  std::optional<Answer> answer;    ///< with Done
  std::string by = "participant";  ///< as in ScreenResult
};

/// The other side of a session: a person at a window, or a simulated observer. Calls block until done.
class FrontEnd {
 public:
  virtual ~FrontEnd() = default;
  virtual ScreenResult show(const Screen& screen, const Session& session) = 0;
  virtual TrialResult present(const Trial& trial, const Session& session) = 0;
  /// After an answer in practice with feedback.
  virtual void feedback(bool correct) = 0;
  /// Codes of the notes (see privacy.h) that the experimenter took since the last call, for events of kind
  /// Note. Called after each screen and each trial.
  virtual std::vector<std::string> takeNotes() { return {}; }
  /// The machine this runs on: refresh rate, GPU, window system, whether it is fit for a lab.
  virtual nlohmann::json environment() const = 0;
};

}  // namespace limen::study
