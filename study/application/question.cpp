// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/question.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "study/protocol/design.h"

namespace limen::study {
namespace {

int firstLetter(const std::string& word) {
  const auto first = static_cast<unsigned char>(word.empty() ? '\0' : word[0]);
  return first < 0x80 && std::isalpha(first) ? std::tolower(first) : window::kKeyNone;
}

std::string upper(int letter) { return {static_cast<char>(std::toupper(letter))}; }

std::vector<PageButton> digitButtons(const std::vector<std::string>& labels) {
  std::vector<PageButton> buttons;
  for (size_t i = 0; i < labels.size(); ++i) {
    PageButton button{static_cast<int>(i), labels[i], "", "", {}, true};
    if (i < 10) {
      button.keys = {i == 9 ? '0' : '1' + static_cast<int>(i)};
      button.hint = {static_cast<char>(button.keys[0])};
    }
    buttons.push_back(button);
  }
  return buttons;
}

bool isLeftRight(const TaskSetting& task) {
  return task.type == Task::Alternative || (task.type == Task::Pairwise && task.sideBySide);
}

std::string keyName(int key) {
  if (key > ' ' && key < 0x7F) return {static_cast<char>(key)};
  switch (key) {
    case window::kKeyLeft:
    case window::kPadLeft:
      return "left";
    case window::kKeyRight:
    case window::kPadRight:
      return "right";
    case window::kKeyUp:
    case window::kPadUp:
      return "up";
    case window::kKeyDown:
    case window::kPadDown:
      return "down";
    case window::kKeyEnter:
      return "enter";
    case window::kKeySpace:
      return "space";
    case window::kKeyBackspace:
      return "backspace";
    case window::kPadAccept:
      return "accept";
    case window::kPadBack:
      return "back";
    case window::kPadStart:
      return "start";
    default:
      return "other";
  }
}

double secondsBetween(int64_t from, int64_t to) { return static_cast<double>(to - from) * 1e-9; }

}  // namespace

std::vector<PageButton> answerButtons(const TaskSetting& task, const AskedHow& how) {
  const Words& words = how.words;
  const std::vector<std::string>& labels = task.labels.empty() ? task.answers : task.labels;
  std::vector<std::string> shown;
  const std::vector<size_t> order = answersShown(task, how.mirrored);
  for (const size_t i : order) shown.push_back(labels[i]);
  std::vector<PageButton> buttons = digitButtons(shown);
  for (size_t i = 0; i < buttons.size(); ++i) buttons[i].id = static_cast<int>(order[i]);
  if (task.type == Task::Rating || buttons.size() != 2) return buttons;
  const std::string arrows[] = {"\u2190", "\u2192"};
  const auto orArrow = [&](const std::string& key, size_t side) {
    std::string hint = words.filled("key_or_arrow", {{"key", key}, {"arrow", arrows[side]}});
    for (size_t at = hint.find(' '); at != std::string::npos; at = hint.find(' ', at))
      hint.replace(at, 1, "\u00A0");
    return hint;
  };
  buttons[0].keys.insert(buttons[0].keys.end(), {window::kKeyLeft, window::kPadLeft});
  buttons[1].keys.insert(buttons[1].keys.end(), {window::kKeyRight, window::kPadRight});
  buttons[0].padHint = words["pad_left"];
  buttons[1].padHint = words["pad_right"];
  const int left = firstLetter(shown[0]), right = firstLetter(shown[1]);
  if (isLeftRight(task)) {
    for (size_t side = 0; side < 2; ++side) buttons[side].hint = arrows[side];
  } else if (task.type == Task::YesNo && left != window::kKeyNone && right != window::kKeyNone &&
             left != right) {
    buttons[0].keys.push_back(left);
    buttons[1].keys.push_back(right);
    buttons[0].hint = orArrow(upper(left), 0);
    buttons[1].hint = orArrow(upper(right), 1);
  } else {
    for (size_t side = 0; side < 2; ++side) buttons[side].hint = orArrow(buttons[side].hint, side);
  }
  return buttons;
}

std::vector<PageButton> scaleButtons(const Scale& scale) { return digitButtons(scale.labels); }

std::string earlyKeyName(const TaskSetting& task, const window::Input& input) {
  if (input.device == window::Device::Mouse) return "mouse";
  for (const PageButton& button : answerButtons(task))
    if (std::find(button.keys.begin(), button.keys.end(), input.key) != button.keys.end())
      return keyName(input.key);
  return "other";
}

int answerColumns(const TaskSetting& task) {
  if (task.type != Task::Alternative || task.alternatives <= 3) return 0;
  return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(task.alternatives))));
}

bool asksSeverity(const TaskSetting& task, int answer) {
  return task.severity && (task.severityAlways || (task.type == Task::YesNo && answer == 0));
}

std::string questionOf(const TaskSetting& task, const Words& words) {
  return task.question.empty() ? words["question_" + std::string(limen::toText(task.type))] : task.question;
}

std::string answerHelp(const TaskSetting& task, const AskedHow& how) {
  std::string answers;
  for (const PageButton& button : answerButtons(task, how))
    answers +=
        (answers.empty() ? "" : ", ") + button.label + (button.hint.empty() ? "" : " (" + button.hint + ")");
  return how.words.filled("answer_help", {{"answers", answers}});
}

QuestionScreen::QuestionScreen(const TaskSetting& task, int64_t stimulusEndNs, const AskedHow& how)
    : task_(task), how_(how), stimulusEndNs_(stimulusEndNs) {}

std::string QuestionScreen::name() const {
  return step_ == Step::Answer ? "question" : step_ == Step::Severity ? "severity" : "confidence";
}

bool QuestionScreen::timedOut(int64_t nowNs, double timeoutS) const {
  return timeoutS > 0 && step_ == Step::Answer && shownNs() && secondsBetween(*shownNs(), nowNs) > timeoutS;
}

Page QuestionScreen::build(int64_t) const {
  Page page;
  switch (step_) {
    case Step::Answer:
      page.question = questionOf(task_, how_.words);
      page.buttons = answerButtons(task_, how_);
      page.columns = answerColumns(task_);
      break;
    case Step::Severity:
      page.question = task_.severity->question;
      page.buttons = scaleButtons(*task_.severity);
      break;
    case Step::Confidence:
      page.question = task_.confidence->question;
      page.buttons = scaleButtons(*task_.confidence);
      break;
  }
  return page;
}

void QuestionScreen::pressed(int id, const window::Input& input) {
  const double sinceShownS = secondsBetween(*shownNs(), input.timeNs);
  switch (step_) {
    case Step::Answer:
      choice_ = id;
      answer_.answer = task_.answers[static_cast<size_t>(id)];
      answer_.questionNs = *shownNs();
      answer_.answeredNs = input.timeNs;
      answer_.reactionTimeS = secondsBetween(std::max(stimulusEndNs_, *shownNs()), input.timeNs);
      answer_.device = toText(input.device);
      break;
    case Step::Severity:
      answer_.severity = id + 1;
      answer_.extra["severity_reaction_time_s"] = sinceShownS;
      break;
    case Step::Confidence:
      answer_.confidence = id + 1;
      answer_.extra["confidence_reaction_time_s"] = sinceShownS;
      break;
  }
  next();
}

void QuestionScreen::next() {
  if (step_ == Step::Answer && asksSeverity(task_, choice_))
    step_ = Step::Severity;
  else if (step_ != Step::Confidence && task_.confidence)
    step_ = Step::Confidence;
  else
    return finish();
  turn();
}

}  // namespace limen::study
