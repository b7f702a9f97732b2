// SPDX-License-Identifier: BSD-3-Clause
#include "tests/study/session/session_fixture.h"

namespace limen::study {
namespace {

using testing::HasSubstr;

nlohmann::json dueOf(const Session& session) {
  const Step& step = session.step();
  nlohmann::json due = {{"kind", static_cast<int>(step.kind)}};
  if (step.screen) due["screen"] = toText(step.screen->kind);
  if (step.trial) {
    due["trial"] = {step.trial->number, step.trial->attempt, step.trial->seed};
    due["level"] = step.trial->procedureStimulus;
    for (const Stimulus& stimulus : step.trial->stimuli) due["stimuli"].push_back(toJson(stimulus));
  }
  return due;
}

// The same events applied to a new session lead to the same state after each of them: what a running session
// knew comes from its events alone.
TEST(Replay, EveryPrefixOfALogGivesTheStateThatTheRunningSessionHad) {
  Protocol protocol = largeProtocol();
  protocol.session.repeatInvalidAtMost = 1;
  for (const ResumePolicy policy : {ResumePolicy::Resume, ResumePolicy::RestartBlock}) {
    protocol.session.resume = policy;
    TestClock clock;
    struct Watching : ScriptedFrontEnd {
      using ScriptedFrontEnd::ScriptedFrontEnd;
      ScreenResult show(const Screen& screen, const Session& session) override {
        seen[session.nextEvent()] = {session.state(), dueOf(session)};
        return ScriptedFrontEnd::show(screen, session);
      }
      TrialResult present(const Trial& trial, const Session& session) override {
        seen[session.nextEvent()] = {session.state(), dueOf(session)};
        return ScriptedFrontEnd::present(trial, session);
      }
      std::map<int, std::pair<nlohmann::json, nlohmann::json>> seen;
    } frontEnd(protocol);
    frontEnd.trialOutcome = [](const Trial& trial, const Session& session) {
      return trial.number % 5 == 0 && session.timesInvalid(trial.number) < trial.number % 4 ? Outcome::Invalid
                                                                                            : Outcome::Done;
    };
    std::vector<Event> events;
    runInMemory(protocol, 11, 0, frontEnd, clock, events);
    ASSERT_GT(events.size(), 100U);
    ASSERT_GT(frontEnd.seen.size(), 50U);
    for (const auto& [count, expected] : frontEnd.seen) {
      Session replayed(protocol, 11, 0);
      for (int i = 0; i < count; ++i) replayed.apply(events[static_cast<size_t>(i)]);
      ASSERT_EQ(replayed.state(), expected.first) << count;
      ASSERT_EQ(dueOf(replayed), expected.second) << count;
    }
  }
}

TEST(Replay, EventsThatCannotFollowAreRefusedWithWhatWasDue) {
  const Protocol protocol = smallProtocol(3, 0);
  TestClock clock;
  ScriptedFrontEnd frontEnd(protocol);
  std::vector<Event> events;
  runInMemory(protocol, 5, 0, frontEnd, clock, events);
  const auto applyAll = [&](const std::vector<Event>& log) {
    return errorOf([&] {
      Session session(protocol, 5, 0);
      for (const Event& event : log) session.apply(event);
    });
  };
  ASSERT_EQ(applyAll(events), "no error");
  // started, instructions, block_start, trial_started 0, answered, ...
  auto without = events;
  without.erase(without.begin() + 3);
  EXPECT_THAT(applyAll(without), HasSubstr("event 4 (answered) has not number 3"));
  auto skipped = events;
  skipped.erase(skipped.begin() + 3);
  for (size_t i = 0; i < skipped.size(); ++i) skipped[i].number = static_cast<int>(i);
  EXPECT_THAT(applyAll(skipped), HasSubstr("event 3 (answered) ends no trial; due was trial 0, attempt 0"));
  auto other = events;
  other[3].data["trial"] = 2;
  EXPECT_THAT(applyAll(other), HasSubstr("begins trial 2, attempt 0; due was trial 0, attempt 0"));
  auto screen = events;
  screen[1].data["screen"] = "break";
  EXPECT_THAT(applyAll(screen), HasSubstr("leaves a different screen; due was screen instructions"));
  auto empty = events;
  empty[4].data.erase("answer");
  EXPECT_THAT(applyAll(empty), HasSubstr("event 4 (answered) lacks required data"));
  auto seed = events;
  seed[0].data["seed"] = "6";
  EXPECT_THAT(applyAll(seed), HasSubstr("has another seed"));
  auto late = events;
  late.push_back({static_cast<int>(late.size()), EventKind::Paused, "", 0, nlohmann::json::object()});
  EXPECT_THAT(applyAll(late), HasSubstr("follows the end"));
  auto early = std::vector<Event>{events[0], events.back()};
  early[1].number = 1;
  EXPECT_THAT(applyAll(early), HasSubstr("comes too early"));
}

// A session of the version before plans had one: its log has neither, and its catch trials showed the state
// before the change.
TEST(Replay, ASessionOfAnEarlierPlanIsReplayedAsItBegan) {
  const Protocol protocol = smallProtocol(3, 4);
  std::vector<std::string> hashes;
  const Design design = makeDesign(protocol, 5, 1);
  for (const PlannedTrial& trial : design.blocks[0].trials) {
    PlannedTrial old = trial;
    old.unchangedShowsAfter.reset();
    hashes.push_back(stimulusHash(stimuliOf(protocol, old)[0]));
  }
  TestClock clock;
  ScriptedFrontEnd frontEnd(protocol);
  std::vector<Event> events;
  runInMemory(protocol, 5, 1, frontEnd, clock, events);
  size_t trial = 0;
  for (Event& event : events) {
    if (event.kind == EventKind::TrialStarted) event.data["stimulus_hashes"] = {hashes.at(trial++)};
    if (event.kind != EventKind::Started) continue;
    EXPECT_EQ(planVersionOf(event.data), kPlanVersion);
    EXPECT_EQ(event.data.at("answers_from_the_left").at("main"), (nlohmann::json{"no", "yes"}))
        << "participant 1";
    event.data.erase("plan_version");
    event.data.erase("answers_from_the_left");
  }
  const auto applyAll = [&](int version) {
    return errorOf([&] {
      Session session(protocol, 5, 1, version);
      for (const Event& event : events) session.apply(event);
    });
  };
  EXPECT_EQ(planVersionOf(events[0].data), 1);
  EXPECT_EQ(applyAll(1), "no error");
  EXPECT_THAT(applyAll(kPlanVersion), HasSubstr("has another version of the plan"));
  EXPECT_THAT(errorOf([] {
                planVersionOf({{"plan_version", kPlanVersion + 1}});
              }),
              HasSubstr("newer version"));
}

TEST(Replay, KindsOfEventsHaveNames) {
  for (int kind = 0; kind <= static_cast<int>(EventKind::Finished); ++kind)
    EXPECT_EQ(eventKind(toText(static_cast<EventKind>(kind))), static_cast<EventKind>(kind));
  EXPECT_THAT(errorOf([] { eventKind("danced"); }), HasSubstr("unknown kind 'danced'"));
}

// Right and wrong by the definitions of the tasks.
TEST(Answers, AreRightOrWrongByTask) {
  Part part;
  PlannedTrial trial;
  part.task.answers = {"yes", "no"};
  for (const bool change : {true, false}) {
    trial.change = change;
    EXPECT_EQ(Session::isCorrect(part, trial, "yes"), change);
    EXPECT_EQ(Session::isCorrect(part, trial, "no"), !change);
    EXPECT_EQ(Session::outcomeOf(part, trial, "yes"), 1);
    EXPECT_EQ(Session::outcomeOf(part, trial, "no"), 0);
  }
  part.task.type = Task::Alternative;
  part.task.answers = {"left", "middle", "right"};
  trial.target = 2;
  EXPECT_EQ(Session::isCorrect(part, trial, "right"), true);
  EXPECT_EQ(Session::isCorrect(part, trial, "middle"), false);
  EXPECT_EQ(Session::outcomeOf(part, trial, "right"), 1);
  EXPECT_EQ(Session::outcomeOf(part, trial, "left"), 0);
  part.task.type = Task::Rating;
  EXPECT_EQ(Session::isCorrect(part, trial, "middle"), std::nullopt);
  EXPECT_EQ(Session::outcomeOf(part, trial, "middle"), 1);
  part.task.type = Task::Pairwise;
  EXPECT_EQ(Session::isCorrect(part, trial, "left"), std::nullopt);
  EXPECT_EQ(Session::outcomeOf(part, trial, "right"), 2);
}

}  // namespace
}  // namespace limen::study
