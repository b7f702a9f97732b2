// SPDX-License-Identifier: BSD-3-Clause
// Trials shown on displays of known behaviour: what was on them, and what is said about it.
#include "study/presentation/presenter.h"

#include <gtest/gtest.h>

#include "experiments/base/error.h"
#include "study/presentation/virtual_screen.h"

namespace limen::study {
namespace {

using Item = VirtualScreen::Drawn::Item;

/// A picture's texture is its stimulus, its layer its frame.
class Numbered : public PictureSource {
 public:
  Picture picture(int stimulus, int frame) override { return {static_cast<uint32_t>(stimulus), frame}; }
};

/// Fixation of 3 blanks, two intervals of 12 frames with a gap of 12 between, end: blanks 3 to 14, 27 to 38.
/// The second one changes with its seventh frame, blank 33.
Schedule twoIntervals() {
  Stimulus with;
  with.levels = LevelChange{};
  with.durationS = 0.2;
  with.changeAtS = 0.1;
  Stimulus without = with;
  without.changes = false;
  ScheduleSetting setting;
  setting.task.type = Task::Interval;
  setting.timing = {.fixationS = 0.05, .afterFixationS = 0.0, .intervalGapS = 0.2, .betweenTrialsS = 0.0};
  setting.windowPx = {400, 300};
  setting.screenPx = {1920, 1080};
  return makeSchedule({without, with}, setting);
}

Shown showOn(const VirtualDisplay& display, const PresenterSetting& setting = {}) {
  VirtualScreen screen(display);
  Numbered pictures;
  return present(twoIntervals(), pictures, screen, setting);
}

ScreenEvent pressedKey(const char* name) { return {ScreenEvent::Kind::Key, name, {}, 0}; }

TEST(Presenter, ShowsEveryFrameOnceInItsTurn) {
  VirtualDisplay display;
  display.jitterMs = 0.5;
  VirtualScreen screen(display);
  Numbered pictures;
  const Schedule schedule = twoIntervals();
  const Shown shown = present(schedule, pictures, screen, {});
  EXPECT_TRUE(shown.valid) << shown.reason;
  ASSERT_EQ(screen.shown().size(), 40U);
  for (int blank = 0; blank < 40; ++blank) {
    const auto& drawn = screen.shown()[static_cast<size_t>(blank)];
    EXPECT_EQ(drawn.background, 0.05);
    if (blank < 3) {
      EXPECT_EQ(drawn.items.size(), 2U) << "the cross";
      EXPECT_EQ(drawn.items[0].kind, Item::Kind::Fill);
    } else if (blank < 15 || (blank >= 27 && blank < 39)) {
      ASSERT_EQ(drawn.items.size(), 1U);
      const int stimulus = blank < 15 ? 0 : 1;
      EXPECT_EQ(drawn.items[0].picture,
                (Picture{static_cast<uint32_t>(stimulus), blank - (stimulus ? 27 : 3)}));
      EXPECT_EQ(drawn.items[0].atPx, glm::dvec2(760.0, 390.0));
      EXPECT_EQ(drawn.items[0].sizePx, glm::dvec2(400.0, 300.0));
    } else {
      EXPECT_TRUE(drawn.items.empty()) << blank;
    }
  }
  ASSERT_EQ(shown.frames.size(), 24U);
  EXPECT_EQ(shown.frames[12].stimulus, 1);
  EXPECT_EQ(shown.frames[12].frame, 0);
  for (size_t i = 1; i < shown.frames.size(); ++i)
    EXPECT_GT(shown.frames[i].swapNs, shown.frames[i - 1].swapNs);
  // 40 blanks after the clock's start at 1 s.
  EXPECT_NEAR(1e-9 * static_cast<double>(shown.endNs), 1.0 + 40.0 / 60.0, 0.001);
}

TEST(Presenter, AFrameThatStaysTooLongMakesTheTrialInvalid) {
  VirtualDisplay display;
  display.jitterMs = 0.5;
  display.drops = {{30, 2}};
  const Shown shown = showOn(display);
  EXPECT_FALSE(shown.valid);
  EXPECT_EQ(shown.reason, "2 missed frames");
  EXPECT_EQ(shown.frames.at(15).missedBlanks, 2);  // blank 30 is the fourth frame of the second interval
  PresenterSetting lenient;
  lenient.missedBlanksAtMost = 2;
  EXPECT_TRUE(showOn(display, lenient).valid);
  // The last frame stays on if the blank that takes it away is missed.
  display.drops = {{39, 1}};
  EXPECT_EQ(showOn(display).reason, "1 missed frame");
  // A pause that is longer by a blank shows nothing wrong.
  display.drops = {{20, 1}};
  EXPECT_TRUE(showOn(display).valid);
  display.drops = {};
  display.early = {31};
  EXPECT_EQ(showOn(display).reason, "1 frame shown too briefly");
}

TEST(Presenter, MarksStimuliAndTheChangeAtTheirSwaps) {
  std::vector<std::pair<MarkerKind, int64_t>> marks;
  PresenterSetting setting;
  setting.mark = [&](MarkerKind kind, int64_t swapNs) { marks.emplace_back(kind, swapNs); };
  const Shown shown = showOn({}, setting);
  ASSERT_EQ(shown.frames.size(), 24U);
  ASSERT_EQ(marks.size(), 5U);
  const MarkerKind kinds[] = {MarkerKind::Stimulus, MarkerKind::StimulusEnd, MarkerKind::Stimulus,
                              MarkerKind::Change, MarkerKind::StimulusEnd};
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(marks[i].first, kinds[i]) << i;
  EXPECT_EQ(marks[0].second, shown.frames[0].swapNs);
  EXPECT_EQ(marks[2].second, shown.frames[12].swapNs);
  EXPECT_EQ(marks[3].second, shown.frames[18].swapNs) << "the seventh frame of the second interval";
  EXPECT_EQ(marks[4].second, shown.endNs) << "the frame that takes the last picture away";
}

TEST(Presenter, AnotherRateThanTheSchedulesIsInvalid) {
  VirtualDisplay display;
  display.refreshHz = 75.0;
  EXPECT_EQ(showOn(display).reason, "the display runs at 75.00 Hz, not 60.00");
}

TEST(Presenter, ALostWindowEndsTheTrial) {
  VirtualDisplay display;
  display.lostAt = 10;
  const Shown shown = showOn(display);
  EXPECT_FALSE(shown.valid);
  EXPECT_FALSE(shown.stopped);
  EXPECT_EQ(shown.reason, "window lost");
  EXPECT_EQ(shown.swaps.swaps.size(), 11U);
}

TEST(Presenter, AnswersBeforeTheQuestionAreKnownByWhenTheyCame) {
  const auto isAnswer = [](const ScreenEvent& event) { return event.name == "1" || event.name == "2"; };
  for (const auto& [swap, reason] : {std::pair{1, "answered during the fixation"},
                                     {5, "answered during the stimulus"},
                                     {20, "answered during the blank"},
                                     {39, ""}}) {
    VirtualDisplay display;
    display.events = {{swap, pressedKey("1")}};
    const Shown shown = showOn(display);
    EXPECT_TRUE(shown.valid);
    ASSERT_EQ(shown.inputs.size(), 1U);
    EXPECT_GT(shown.inputs[0].event.timeNs, 0);
    EXPECT_EQ(earlyAnswer(shown, isAnswer), reason);
  }
  VirtualDisplay display;
  display.events = {{5, pressedKey("x")}};
  EXPECT_EQ(earlyAnswer(showOn(display), isAnswer), "");
}

TEST(Presenter, AnEventMayStopTheTrial) {
  VirtualDisplay display;
  display.events = {{5, pressedKey("escape")}};
  PresenterSetting setting;
  setting.stop = [](const ScreenEvent& event) {
    return event.name == "escape" ? std::string("paused in the middle") : std::string();
  };
  const Shown shown = showOn(display, setting);
  EXPECT_TRUE(shown.stopped);
  EXPECT_FALSE(shown.valid);
  EXPECT_EQ(shown.reason, "paused in the middle");
  EXPECT_EQ(shown.swaps.swaps.size(), 6U);
  display.events = {{5, {ScreenEvent::Kind::Close, {}, {}, 0}}};
  EXPECT_EQ(showOn(display).reason, "window closed");
}

TEST(Presenter, PatchIsWhiteOnOddAndOnChangedFrames) {
  VirtualScreen screen(VirtualDisplay{});
  Numbered pictures;
  PresenterSetting setting;
  setting.patch = {40, Corner::LowerRight};
  present(twoIntervals(), pictures, screen, setting);
  for (int blank = 0; blank < 40; ++blank) {
    const Item& patch = screen.shown()[static_cast<size_t>(blank)].items.back();
    EXPECT_EQ(patch.kind, Item::Kind::Fill);
    EXPECT_EQ(patch.atPx, glm::dvec2(1880.0, 1040.0));
    const bool first = blank >= 3 && blank < 15, second = blank >= 27 && blank < 39;
    const bool white = (first && (blank - 3) % 2 == 1) || (second && (blank >= 33 || (blank - 27) % 2 == 1));
    EXPECT_EQ(patch.light, white ? 1.0 : 0.0) << blank;
  }
  EXPECT_EQ(cornerOf("upper_right"), Corner::UpperRight);
  EXPECT_THROW(cornerOf("top"), Error);
}

TEST(Presenter, SideBySideDrawsAllAndHoldsWhatHasEnded) {
  Stimulus longer;
  longer.levels = LevelChange{};
  longer.durationS = 0.3;
  longer.changeAtS = 0.1;
  Stimulus shorter = longer;
  shorter.durationS = 0.2;
  longer.cue = shorter.cue = {Cue::Kind::Arrow, 30.0, 40.0, 50.0, 0.1};
  ScheduleSetting setting;
  setting.task.type = Task::Alternative;
  setting.timing = {.fixationS = 0.0, .afterFixationS = 0.0, .intervalGapS = 0.0, .betweenTrialsS = 0.0};
  setting.windowPx = {400, 300};
  VirtualScreen screen(VirtualDisplay{});
  Numbered pictures;
  const Schedule schedule = makeSchedule({longer, shorter}, setting);
  EXPECT_TRUE(present(schedule, pictures, screen, {}).valid);
  // Six blanks of cue: two pictures, each with its arrow; the second lies 400 + 32 px to the right.
  const std::vector<Item>& cue = screen.shown()[0].items;
  ASSERT_EQ(cue.size(), 4U);
  EXPECT_EQ(cue[1].kind, Item::Kind::Arrow);
  EXPECT_EQ(cue[3].atPx - cue[1].atPx, glm::dvec2(432.0, 0.0));
  EXPECT_EQ(cue[1].atPx - cue[0].atPx, glm::dvec2(30.0, 40.0));
  const std::vector<Item>& last = screen.shown()[6 + 17].items;
  ASSERT_EQ(last.size(), 2U);
  EXPECT_EQ(last[0].picture.layer, 17);
  EXPECT_EQ(last[1].picture.layer, 11);
}

}  // namespace
}  // namespace limen::study
