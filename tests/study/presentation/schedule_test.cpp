// SPDX-License-Identifier: BSD-3-Clause
// Schedules against blanks counted by hand.
#include "study/presentation/schedule.h"

#include <gtest/gtest.h>

#include "experiments/base/error.h"

namespace limen::study {
namespace {

/// 0.2 s with its change at 0.1 s: 12 frames at 60 Hz, the seventh is changed.
Stimulus stimulus() {
  Stimulus out;
  out.levels = LevelChange{};
  out.durationS = 0.2;
  out.changeAtS = 0.1;
  return out;
}

ScheduleSetting setting(Task task) {
  ScheduleSetting out;
  out.task.type = task;
  out.timing = {.fixationS = 0.05, .afterFixationS = 0.1, .intervalGapS = 0.2, .betweenTrialsS = 0.15};
  out.windowPx = {400, 300};
  out.screenPx = {1000, 800};
  return out;
}

std::vector<std::pair<PhaseKind, int>> phases(const Schedule& schedule) {
  std::vector<std::pair<PhaseKind, int>> out;
  int first = 0;
  for (const Phase& phase : schedule.phases) {
    EXPECT_EQ(phase.first, first);
    first += phase.blanks;
    out.emplace_back(phase.kind, phase.blanks);
  }
  EXPECT_EQ(first, schedule.blanks());
  return out;
}

using enum PhaseKind;
using Sequence = study::Stimulus;  // PhaseKind has a Stimulus too

TEST(Schedule, OneSequenceWithCueAndShowings) {
  Sequence one = stimulus();
  one.showings = 3;
  one.gapS = 0.5;
  one.cue = {Cue::Kind::Circle, 10.0, 20.0, 50.0, 2.0};
  const Schedule schedule = makeSchedule({one}, setting(Task::YesNo));
  EXPECT_EQ(phases(schedule), (std::vector<std::pair<PhaseKind, int>>{{BetweenTrials, 9},
                                                                      {Fixation, 3},
                                                                      {AfterFixation, 6},
                                                                      {Cue, 120},
                                                                      {PhaseKind::Stimulus, 12},
                                                                      {ShowingGap, 30},
                                                                      {PhaseKind::Stimulus, 12},
                                                                      {ShowingGap, 30},
                                                                      {PhaseKind::Stimulus, 12},
                                                                      {End, 1}}));
  // The cue stands over the first frame; the second showing begins at blank 9 + 3 + 6 + 120 + 12 + 30 = 180.
  EXPECT_EQ(schedule.due[18].frame, 0);
  EXPECT_EQ(schedule.due[137].frame, 0);
  EXPECT_EQ(schedule.due[150].frame, -1);
  EXPECT_EQ(schedule.due[180].frame, 0);
  EXPECT_EQ(schedule.due[185].frame, 5);
  EXPECT_FALSE(schedule.due[185].after);
  EXPECT_EQ(schedule.due[186].frame, 6);
  EXPECT_TRUE(schedule.due[186].after);
  EXPECT_EQ(schedule.phaseOf(186).showing, 1);
  EXPECT_EQ(schedule.due.back().frame, -1);
  // In the middle of the screen: (1000 - 400) / 2, (800 - 300) / 2.
  EXPECT_EQ(schedule.places, (std::vector<Place>{{{300, 250}, {400, 300}}}));
}

TEST(Schedule, IntervalsFollowOneAnother) {
  Sequence other = stimulus();
  other.changes = false;
  ScheduleSetting two = setting(Task::Interval);
  two.timing.betweenTrialsS = two.timing.afterFixationS = 0.0;
  const Schedule schedule = makeSchedule({other, stimulus()}, two);
  EXPECT_EQ(
      phases(schedule),
      (std::vector<std::pair<PhaseKind, int>>{
          {Fixation, 3}, {PhaseKind::Stimulus, 12}, {IntervalGap, 12}, {PhaseKind::Stimulus, 12}, {End, 1}}));
  EXPECT_EQ(schedule.phaseOf(3).stimulus, 0);
  EXPECT_EQ(schedule.phaseOf(27).stimulus, 1);
  EXPECT_FALSE(schedule.due[14].after);  // the twelfth frame of a sequence without change
  EXPECT_TRUE(schedule.due[33].after);   // 3 + 12 + 12 + 6
  EXPECT_EQ(schedule.places[0], schedule.places[1]);
}

TEST(Schedule, SideBySideAllAreShownAtOnce) {
  Sequence longer = stimulus();
  longer.durationS = 0.3;
  longer.changes = false;
  const Schedule schedule = makeSchedule({longer, stimulus()}, setting(Task::Alternative));
  EXPECT_TRUE(schedule.sideBySide);
  EXPECT_EQ(phases(schedule).at(3), (std::pair{PhaseKind::Stimulus, 18}));  // as long as the longest
  EXPECT_TRUE(schedule.due[18 + 6].after);
  // 2 x 400 and 32 between: 84 px are left on either side of 1000.
  EXPECT_EQ(schedule.places, (std::vector<Place>{{{84, 250}, {400, 300}}, {{516, 250}, {400, 300}}}));
  Sequence odd = stimulus();
  odd.showings = 2;
  EXPECT_THROW(makeSchedule({stimulus(), odd}, setting(Task::Alternative)), Error);
  // A cue of one of them is a cue of the trial: 0.1 s are 6 blanks.
  Sequence cued = stimulus();
  cued.cue = {Cue::Kind::Arrow, 10.0, 10.0, 50.0, 0.1};
  EXPECT_EQ(phases(makeSchedule({stimulus(), cued}, setting(Task::Alternative))).at(3), (std::pair{Cue, 6}));
  // One after the other for the same task if so asked.
  ScheduleSetting turns = setting(Task::Pairwise);
  turns.task.sideBySide = false;
  EXPECT_FALSE(makeSchedule({stimulus(), stimulus()}, turns).sideBySide);
}

TEST(Schedule, WindowsFormAGridWhereARowIsTooLong) {
  // Three of 400 do not fit into 1000: two and one, the last in the middle. Rows: (800 - 632) / 2 = 84.
  EXPECT_EQ(placesOf(3, {400, 300}, {1000, 800}, 32),
            (std::vector<Place>{{{84, 84}, {400, 300}}, {{516, 84}, {400, 300}}, {{300, 416}, {400, 300}}}));
  EXPECT_THROW(placesOf(5, {400, 300}, {1000, 800}, 32), Error);
  EXPECT_THROW(placesOf(1, {1001, 300}, {1000, 800}, 32), Error);
}

TEST(Schedule, PausesTakeTheNearestBlanksAndNeverVanish) {
  EXPECT_EQ(blanksFor(0.5, 60.0), 30);
  EXPECT_EQ(blanksFor(0.5, 59.94), 30);   // 29.97
  EXPECT_EQ(blanksFor(0.51, 60.0), 31);   // 30.6
  EXPECT_EQ(blanksFor(0.507, 60.0), 30);  // 30.42
  EXPECT_EQ(blanksFor(0.001, 60.0), 1);
  EXPECT_EQ(blanksFor(0.0, 60.0), 0);
}

TEST(Schedule, NothingToShowIsRefused) {
  EXPECT_THROW(makeSchedule({}, setting(Task::YesNo)), Error);
  Sequence never = stimulus();
  never.showings = 0;
  EXPECT_THROW(makeSchedule({never}, setting(Task::YesNo)), Error);
}

}  // namespace
}  // namespace limen::study
