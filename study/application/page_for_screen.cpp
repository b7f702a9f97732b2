// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/question.h"
#include "study/application/screens.h"
#include "study/application/window_front_end.h"

namespace limen::study {
namespace {

std::string orElse(const std::string& text, const std::string& otherwise) {
  return text.empty() ? otherwise : text;
}

std::string progressLine(const Screen& screen, const Words& words) {
  return words.filled("progress", {{"done", std::to_string(screen.trialsDone)},
                                   {"count", std::to_string(screen.trialsInAll)}});
}

}  // namespace

std::unique_ptr<PageScreen> pageFor(const Screen& screen, const Session& session) {
  const Protocol& protocol = session.protocol();
  const Texts& texts = protocol.texts;
  const Words& words = protocol.words;
  const Part& part = protocol.parts.at(static_cast<size_t>(screen.part));
  const AskedHow how{session.design().answersMirrored, words};
  TextScreen::Setting setting;
  setting.atLeastS = screen.atLeastS;
  setting.name = toText(screen.kind);
  if (screen.trialsInAll > 0) setting.progress = static_cast<double>(screen.trialsDone) / screen.trialsInAll;
  switch (screen.kind) {
    case Screen::Kind::Consent:
      return std::make_unique<ConsentScreen>(orElse(texts.consent, words["consent_text"]), words);
    case Screen::Kind::Form:
      return std::make_unique<FormScreen>(protocol.form, words);
    case Screen::Kind::Instructions:
      setting.title = words["instructions_title"];
      setting.text =
          orElse(texts.instructions, questionOf(part.task, words)) + "\n\n" + answerHelp(part.task, how);
      setting.progress = -1.0;
      break;
    case Screen::Kind::PracticeStart:
      setting.title = words["practice_title"];
      setting.text = orElse(texts.practice, words["practice_text"]);
      if (part.practice.feedback) setting.text += "\n\n" + words["practice_feedback"];
      setting.button = words["start"];
      setting.progress = -1.0;
      break;
    case Screen::Kind::PracticeResult:
      setting.title = words["practice_done_title"];
      setting.text = screen.passed ? words["practice_passed"] : words["practice_failed"];
      setting.progress = -1.0;
      break;
    case Screen::Kind::BlockStart:
      setting.title = screen.trialsDone == 0 ? words["ready_title"] : words["next_part_title"];
      setting.text = questionOf(part.task, words) + "\n\n" + answerHelp(part.task, how);
      setting.button = words["start"];
      setting.footer = progressLine(screen, words);
      break;
    case Screen::Kind::Break:
      setting.title = words["break_title"];
      setting.text = words["break_text"];
      setting.footer = progressLine(screen, words);
      break;
    case Screen::Kind::Debrief:
      setting.title = words["debrief_title"];
      setting.text = orElse(texts.debrief, words["debrief_text"]);
      setting.button = words["close"];
      setting.progress = -1.0;
      break;
  }
  return std::make_unique<TextScreen>(setting, words);
}

}  // namespace limen::study
