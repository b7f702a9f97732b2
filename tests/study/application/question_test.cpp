// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/question.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/application/resting_pointer.h"

namespace limen::study {
namespace {

constexpr int64_t kMs = 1'000'000;

TaskSetting yesNo() {
  TaskSetting task;
  task.type = Task::YesNo;
  task.answers = {"yes", "no"};
  return task;
}

window::Input key(int code, int64_t timeNs) { return {window::Device::Keyboard, code, 0, 0, timeNs}; }

std::optional<int> pressedBy(const TaskSetting& task, int code,
                             window::Device device = window::Device::Keyboard) {
  Page page;
  page.buttons = answerButtons(task);
  return pressedButton(page, {device, code, 0, 0, 0}, {});
}

TEST(Question, YesAndNoHaveLettersArrowsAndDigits) {
  for (const int code : {int{'y'}, int{window::kKeyLeft}, int{'1'}})
    EXPECT_EQ(pressedBy(yesNo(), code), 0) << code;
  for (const int code : {int{'n'}, int{window::kKeyRight}, int{'2'}})
    EXPECT_EQ(pressedBy(yesNo(), code), 1) << code;
  EXPECT_EQ(pressedBy(yesNo(), window::kPadLeft, window::Device::Gamepad), 0);
  EXPECT_EQ(pressedBy(yesNo(), window::kPadRight, window::Device::Gamepad), 1);
  EXPECT_FALSE(pressedBy(yesNo(), window::kKeySpace));
}

TEST(Question, OnTheOtherSideKeysGoWithWhatIsShown) {
  const AskedHow mirrored{true};
  Page page;
  page.buttons = answerButtons(yesNo(), mirrored);
  ASSERT_EQ(page.buttons.size(), 2U);
  EXPECT_EQ(page.buttons[0].label, "no");
  EXPECT_EQ(page.buttons[1].label, "yes");
  EXPECT_EQ(page.buttons[0].hint, "N\u00A0or\u00A0\u2190");
  const auto pressed = [&](int code, window::Device device = window::Device::Keyboard) {
    return pressedButton(page, {device, code, 0, 0, 0}, {});
  };
  for (const int code : {int{'n'}, int{window::kKeyLeft}, int{'1'}}) EXPECT_EQ(pressed(code), 1) << code;
  for (const int code : {int{'y'}, int{window::kKeyRight}, int{'2'}}) EXPECT_EQ(pressed(code), 0) << code;
  EXPECT_EQ(pressed(window::kPadLeft, window::Device::Gamepad), 1);
  EXPECT_THAT(answerHelp(yesNo(), mirrored), testing::HasSubstr("no (N\u00A0or\u00A0\u2190), yes (Y"));

  const TaskSetting task = yesNo();
  QuestionScreen screen(task, 0, mirrored);
  screen.shown(0);
  screen.take(key(window::kKeyLeft, kMs), {});
  ASSERT_TRUE(screen.done());
  EXPECT_EQ(screen.answer().answer, "no");
}

TEST(Question, StoredAnswersAreTheProtocolsAndShownOnesTheLanguages) {
  const Words german = readWords("german", "");
  TaskSetting task = yesNo();
  task.labels = {german["yes"], german["no"]};
  const std::vector<PageButton> buttons = answerButtons(task, {false, german});
  EXPECT_EQ(buttons[0].label, "ja");
  EXPECT_EQ(buttons[0].hint, "J\u00A0oder\u00A0\u2190");
  QuestionScreen screen(task, 0, {false, german});
  screen.shown(0);
  screen.take(key('j', kMs), {});
  EXPECT_EQ(screen.answer().answer, "yes");
}

TEST(Question, AnswersIgnoreAPointerThatRests) {
  const TaskSetting task = yesNo();
  EXPECT_TRUE(QuestionScreen(task, 0).ignoresRestingPointer());
  RestingPointer pointer({100, 100}, true);
  EXPECT_FALSE(pointer.counts({100, 100}));
  EXPECT_FALSE(pointer.counts({102, 99})) << "the jolt of a click";
  EXPECT_TRUE(pointer.counts({120, 100}));
  EXPECT_TRUE(pointer.counts({100, 100})) << "once moved it may come back";
  EXPECT_TRUE(RestingPointer({100, 100}, false).counts({100, 100}));
}

TEST(Question, LettersFollowTheWords) {
  TaskSetting task = yesNo();
  task.answers = {"ja", "nein"};
  EXPECT_EQ(pressedBy(task, 'j'), 0);
  EXPECT_EQ(pressedBy(task, 'n'), 1);
  EXPECT_FALSE(pressedBy(task, 'y'));
  task.answers = {"seen", "search"};  // the same letter would be a guess
  EXPECT_FALSE(pressedBy(task, 's'));
  EXPECT_EQ(pressedBy(task, window::kKeyLeft), 0);
}

TEST(Question, FourAlternativesHaveDigitsAndStandInASquare) {
  TaskSetting task;
  task.type = Task::Alternative;
  task.alternatives = 4;
  task.answers = {"upper left", "upper right", "lower left", "lower right"};
  for (int i = 0; i < 4; ++i) EXPECT_EQ(pressedBy(task, '1' + i), i);
  EXPECT_FALSE(pressedBy(task, window::kKeyLeft)) << "an arrow says too little";
  EXPECT_EQ(answerColumns(task), 2);
}

TEST(Question, TenthStepHasTheKeyNought) {
  Scale scale;
  for (int i = 0; i < 11; ++i) scale.labels.push_back(std::to_string(i));
  const std::vector<PageButton> buttons = scaleButtons(scale);
  EXPECT_EQ(buttons[9].keys, std::vector<int>{'0'});
  EXPECT_TRUE(buttons[10].keys.empty());
}

TEST(Question, RatingsOfTwoStepsAreNoLeftAndRight) {
  TaskSetting task;
  task.type = Task::Rating;
  task.answers = {"bad", "good"};
  EXPECT_FALSE(pressedBy(task, window::kKeyLeft));
  EXPECT_EQ(pressedBy(task, '2'), 1);
}

TEST(Question, KeysFromBeforeItWasShownDoNotAnswer) {
  const TaskSetting task = yesNo();
  QuestionScreen screen(task, 100 * kMs);
  screen.take(key('y', 150 * kMs), {});
  EXPECT_FALSE(screen.done());
  screen.shown(200 * kMs);
  screen.take(key('y', 199 * kMs), {});
  EXPECT_FALSE(screen.done());
  screen.take(key('n', 950 * kMs), {});
  ASSERT_TRUE(screen.done());
  EXPECT_EQ(screen.answer().answer, "no");
  EXPECT_EQ(screen.answer().device, "keyboard");
  // The stimulus ended 100 ms before the question, which counts as the later of the two: 950 - 200.
  EXPECT_DOUBLE_EQ(screen.answer().reactionTimeS, 0.75);
}

TEST(Question, SeverityComesAfterYesOnlyAndConfidenceAfterBoth) {
  TaskSetting task = yesNo();
  task.severity = Scale{"How strong?", {"hardly", "clearly", "very"}};
  task.confidence = Scale{"How sure?", {"guessed", "sure"}};
  QuestionScreen yes(task, 0);
  yes.shown(10 * kMs);
  yes.take(key('y', 510 * kMs), {});
  EXPECT_EQ(yes.name(), "severity");
  yes.take(key('3', 520 * kMs), {});
  EXPECT_EQ(yes.name(), "severity") << "hit before it was on the screen";
  yes.shown(530 * kMs);
  yes.take(key('3', 830 * kMs), {});
  yes.shown(840 * kMs);
  EXPECT_EQ(yes.name(), "confidence");
  yes.take(key('1', 940 * kMs), {});
  ASSERT_TRUE(yes.done());
  EXPECT_EQ(yes.answer().severity, 3);
  EXPECT_EQ(yes.answer().confidence, 1);
  EXPECT_DOUBLE_EQ(yes.answer().reactionTimeS, 0.5);
  EXPECT_DOUBLE_EQ(yes.answer().extra.at("severity_reaction_time_s").get<double>(), 0.3);
  EXPECT_DOUBLE_EQ(yes.answer().extra.at("confidence_reaction_time_s").get<double>(), 0.1);

  QuestionScreen no(task, 0);
  no.shown(0);
  no.take(key('n', kMs), {});
  EXPECT_EQ(no.name(), "confidence");
  no.shown(2 * kMs);
  no.take(key('2', 3 * kMs), {});
  EXPECT_FALSE(no.answer().severity);
}

TEST(Question, NothingLeadsBackToAnAnswer) {
  TaskSetting task = yesNo();
  task.confidence = Scale{"How sure?", {"guessed", "sure"}};
  QuestionScreen screen(task, 0);
  screen.shown(0);
  screen.take(key('y', kMs), {});
  screen.shown(2 * kMs);
  for (const int code :
       {int{window::kKeyBackspace}, int{window::kKeyEscape}, int{'n'}, int{window::kPadBack}})
    screen.take(key(code, 3 * kMs), {});
  EXPECT_EQ(screen.name(), "confidence");
  EXPECT_EQ(screen.answer().answer, "yes");
}

TEST(Question, TimesOutOnlyWhileTheAnswerIsOpen) {
  TaskSetting task = yesNo();
  task.confidence = Scale{"How sure?", {"guessed", "sure"}};
  QuestionScreen screen(task, 0);
  EXPECT_FALSE(screen.timedOut(9000 * kMs, 2.0)) << "not on the screen yet";
  screen.shown(1000 * kMs);
  EXPECT_FALSE(screen.timedOut(2999 * kMs, 2.0));
  EXPECT_TRUE(screen.timedOut(3001 * kMs, 2.0));
  EXPECT_FALSE(screen.timedOut(3001 * kMs, 0.0));
  screen.take(key('y', 2500 * kMs), {});
  EXPECT_FALSE(screen.timedOut(9000 * kMs, 2.0));
}

TEST(Question, OfKeysPressedEarlyOnlyThoseThatAnswerAreNamed) {
  TaskSetting task;
  task.type = Task::YesNo;
  task.answers = {"yes", "no"};
  const auto name = [&](int key, window::Device device = window::Device::Keyboard) {
    return earlyKeyName(task, {device, key, 0, 0, 0});
  };
  EXPECT_EQ(name('y'), "y");
  EXPECT_EQ(name('2'), "2");
  EXPECT_EQ(name(window::kKeyLeft), "left");
  EXPECT_EQ(name(window::kPadRight, window::Device::Gamepad), "right");
  for (int key = 1; key < 0x3000; ++key) {
    if (key == 'y' || key == 'n' || key == '1' || key == '2' || key == window::kKeyLeft ||
        key == window::kKeyRight || key == window::kPadLeft || key == window::kPadRight)
      continue;
    EXPECT_EQ(name(key), "other") << key;
  }
  EXPECT_EQ(name(window::kKeyNone, window::Device::Mouse), "mouse");
}

}  // namespace
}  // namespace limen::study
