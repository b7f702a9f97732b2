// SPDX-License-Identifier: BSD-3-Clause
#include "study/session/event.h"

#include <array>
#include <utility>

#include "experiments/base/error.h"

namespace limen::study {
namespace {

constexpr std::array<std::pair<EventKind, const char*>, 11> kKinds = {{
    {EventKind::Started, "started"},
    {EventKind::Continued, "continued"},
    {EventKind::ScreenDone, "screen_done"},
    {EventKind::TrialStarted, "trial_started"},
    {EventKind::Answered, "answered"},
    {EventKind::TrialInvalid, "trial_invalid"},
    {EventKind::Paused, "paused"},
    {EventKind::Note, "note"},
    {EventKind::ClockJump, "clock_jump"},
    {EventKind::Aborted, "aborted"},
    {EventKind::Finished, "finished"},
}};

}  // namespace

std::string toText(EventKind kind) {
  for (const auto& [known, name] : kKinds)
    if (known == kind) return name;
  return "?";
}

EventKind eventKind(const std::string& text) {
  for (const auto& [kind, name] : kKinds)
    if (text == name) return kind;
  throw Error("the session's log has an event of unknown kind '" + text + "'", {},
              "use the newer Limen that wrote it");
}

}  // namespace limen::study
