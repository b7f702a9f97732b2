// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "study/application/question.h"
#include "study/application/screens.h"
#include "study/application/window_front_end.h"

namespace limen::study {
namespace {

std::string orElse(const std::string& text, const std::string& otherwise) {
  return text.empty() ? otherwise : text;
}

std::string progressLine(const Screen& screen) {
  return fmt::format("{} of {}", screen.trialsDone, screen.trialsInAll);
}

}  // namespace

std::unique_ptr<PageScreen> pageFor(const Screen& screen, const Session& session) {
  const Protocol& protocol = session.protocol();
  const Texts& texts = protocol.texts;
  const Part& part = protocol.parts.at(static_cast<size_t>(screen.part));
  TextScreen::Setting setting;
  setting.atLeastS = screen.atLeastS;
  setting.name = toText(screen.kind);
  if (screen.trialsInAll > 0) setting.progress = static_cast<double>(screen.trialsDone) / screen.trialsInAll;
  switch (screen.kind) {
    case Screen::Kind::Consent:
      return std::make_unique<ConsentScreen>(orElse(
          texts.consent,
          "You are asked to take part in a study of what people see in computer pictures. Taking part is "
          "voluntary: you can stop at any time, without giving a reason. Your answers are kept under a "
          "code, not under your name."));
    case Screen::Kind::Form:
      return std::make_unique<FormScreen>(protocol.form);
    case Screen::Kind::Instructions:
      setting.title = "What to do";
      setting.text = orElse(texts.instructions, questionOf(part.task)) + "\n\n" + answerHelp(part.task);
      setting.progress = -1.0;
      break;
    case Screen::Kind::PracticeStart:
      setting.title = "Practice";
      setting.text = orElse(texts.practice, "A few rounds to get used to it. They do not count.");
      if (part.practice.feedback) setting.text += "\n\nAfter each answer you are told whether it was right.";
      setting.button = "Start";
      setting.progress = -1.0;
      break;
    case Screen::Kind::PracticeResult:
      setting.title = "Practice done";
      setting.text = screen.passed
                         ? "Well done. From now on you will not be told whether an answer was right."
                         : "Some answers were not as expected. If anything is unclear, ask the "
                           "experimenter before you continue.";
      setting.progress = -1.0;
      break;
    case Screen::Kind::BlockStart:
      setting.title = screen.trialsDone == 0 ? "Ready to start" : "The next part";
      setting.text = questionOf(part.task) + "\n\n" + answerHelp(part.task);
      setting.button = "Start";
      setting.footer = progressLine(screen);
      break;
    case Screen::Kind::Break:
      setting.title = "Break";
      setting.text = "Rest your eyes and look around. Continue when you are ready.";
      setting.footer = progressLine(screen);
      break;
    case Screen::Kind::Debrief:
      setting.title = "Thank you";
      setting.text = orElse(texts.debrief, "That was all. Please tell the experimenter that you are done.");
      setting.button = "Close";
      setting.progress = -1.0;
      break;
  }
  return std::make_unique<TextScreen>(setting);
}

}  // namespace limen::study
