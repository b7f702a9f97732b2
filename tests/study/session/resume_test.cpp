// SPDX-License-Identifier: BSD-3-Clause
#include <sqlite3.h>
#include <unistd.h>

#include <fstream>

#include "experiments/base/process.h"
#include "experiments/store/store.h"
#include "tests/study/session/session_fixture.h"

namespace limen::study {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Killed {};

/// Dies in the middle of a trial, once.
void dieAt(ScriptedFrontEnd& frontEnd, int number) {
  frontEnd.trialOutcome = [number](const Trial& trial, const Session&) -> Outcome {
    if (trial.number == number && trial.attempt == 0) throw Killed();
    return Outcome::Done;
  };
}

/// SQL past the store, as another program would.
std::string sql(const std::string& file, const std::string& statement) {
  sqlite3* database = nullptr;
  sqlite3_open(file.c_str(), &database);
  sqlite3_exec(database, "PRAGMA foreign_keys = ON", nullptr, nullptr, nullptr);
  char* message = nullptr;
  sqlite3_exec(database, statement.c_str(), nullptr, nullptr, &message);
  const std::string out = message ? message : "";
  sqlite3_free(message);
  sqlite3_close(database);
  return out;
}

TEST_F(SessionStoreTest, ATrialThatWasBrokenOffIsShownAgainWithTheSameStimulus) {
  const Protocol protocol = smallProtocol(4, 0);
  ScriptedFrontEnd first(protocol), second(protocol);
  dieAt(first, 2);
  EXPECT_THROW(run(protocol, first), Killed);
  const SessionEnd end = resume(protocol, second);
  EXPECT_EQ(end.kind, Step::Kind::Finished);
  EXPECT_EQ(end.trialsAnswered, 4);
  EXPECT_EQ(end.trialsInvalid, 0);
  EXPECT_THAT(second.log, ElementsAre("2.1", "3.0", "debrief"));
  EXPECT_EQ(stimulusHash(first.trials.back().stimuli[0]), stimulusHash(second.trials[0].stimuli[0]));
  EXPECT_NE(first.trials.back().seed, second.trials[0].seed);
  const std::vector<store::StudyTrial> trials = store::readTrials(request_.store, 1);
  ASSERT_EQ(trials.size(), 5U);
  EXPECT_EQ(trials[2].valid, false);
  EXPECT_EQ(trials[2].reason, "interrupted");
  EXPECT_TRUE(trials[3].counts());
  EXPECT_THAT(verify(protocol), IsEmpty());
}

TEST_F(SessionStoreTest, APauseKeepsTheTrialAndTheFramesThatWereShown) {
  const Protocol protocol = smallProtocol(3, 0);
  ScriptedFrontEnd first(protocol), second(protocol);
  first.trialOutcome = [](const Trial& trial, const Session&) {
    return trial.number == 1 ? Outcome::Paused : Outcome::Done;
  };
  const SessionEnd paused = run(protocol, first);
  EXPECT_EQ(paused.kind, Step::Kind::Trial);
  EXPECT_EQ(store::readSessions(request_.store)[0].state, "paused");
  EXPECT_THAT(verify(protocol), IsEmpty());
  clock_.pass(3600.0);
  EXPECT_EQ(resume(protocol, second).kind, Step::Kind::Finished);
  EXPECT_THAT(second.log, ElementsAre("1.1", "2.0", "debrief"));
  const std::vector<store::StudyTrial> trials = store::readTrials(request_.store, 1, true);
  EXPECT_EQ(trials[1].reason, "paused");
  EXPECT_EQ(trials[1].frames.size(), 3U);
  EXPECT_THAT(verify(protocol), IsEmpty());
  EXPECT_THAT(warnings_, IsEmpty());
  const std::vector<store::StudyEvent> events = store::SessionReader(request_.store).events(1);
  for (const store::StudyEvent& event : events) {
    EXPECT_NE(event.kind, "clock_jump");
    if (event.kind == "continued") {
      EXPECT_NEAR(event.data["gap_s"].get<double>(), 3600.0, 0.1);
    }
  }
}

TEST_F(SessionStoreTest, ABrokenBlockStartsOverAndItsAnswersCountNoMore) {
  Protocol protocol = largeProtocol();
  protocol.session.resume = ResumePolicy::RestartBlock;
  protocol.parts = {protocol.parts[1], protocol.parts[2]};
  ScriptedFrontEnd whole(protocol), first(protocol), second(protocol);
  run(protocol, whole);
  request_.session = "other";
  int shown = 0;
  first.trialOutcome = [&](const Trial&, const Session&) -> Outcome {
    if (shown++ == 6) throw Killed();
    return Outcome::Done;
  };
  EXPECT_THROW(run(protocol, first), Killed);
  EXPECT_EQ(resume(protocol, second).kind, Step::Kind::Finished);
  EXPECT_EQ(second.log.front(), "block_start");
  EXPECT_EQ(second.trials.size(), whole.trials.size());
  for (size_t i = 0; i < whole.trials.size(); ++i) {
    EXPECT_EQ(second.trials[i].number, whole.trials[i].number);
    EXPECT_EQ(second.trials[i].procedureStimulus, whole.trials[i].procedureStimulus);
  }
  store::SessionReader reader(request_.store);
  int superseded = 0, counted = 0;
  for (const store::StudyTrial& trial : reader.trials(2)) {
    superseded += trial.superseded ? 1 : 0;
    counted += trial.counts() ? 1 : 0;
    if (trial.superseded && trial.valid.value()) {
      EXPECT_TRUE(trial.response);
    }
  }
  EXPECT_EQ(superseded, 7);
  EXPECT_EQ(counted, static_cast<int>(whole.trials.size()));
  EXPECT_THAT(verify(protocol), IsEmpty());
}

TEST_F(SessionStoreTest, ABrokenRoundOfPracticeStartsOver) {
  Protocol protocol = smallProtocol(2, 0);
  protocol.session.resume = ResumePolicy::RestartBlock;
  protocol.parts[0].practice = {3, true, 2, 2, true, {}};
  ScriptedFrontEnd first(protocol), second(protocol);
  const auto right = [&](const Trial& trial) { return answerIndex(protocol.parts[0], trial.plan, true); };
  first.answer = second.answer = right;
  dieAt(first, 2);
  EXPECT_THROW(run(protocol, first), Killed);
  second.answer = [&](const Trial& trial) {  // one right answer: the two before the break no longer help
    return answerIndex(protocol.parts[0], trial.plan, trial.number == 0 || trial.number > 2);
  };
  EXPECT_EQ(resume(protocol, second).kind, Step::Kind::Finished);
  EXPECT_THAT(second.log,
              ElementsAre("practice_start", "0.1", "right", "1.1", "wrong", "2.1", "wrong", "practice_result",
                          "practice_start", "5.0", "right", "6.0", "right", "7.0", "right", "practice_result",
                          "block_start", "3.0", "4.0", "debrief"));
  EXPECT_THAT(verify(protocol), IsEmpty());
}

TEST_F(SessionStoreTest, BetweenBlocksNothingStartsOver) {
  Protocol protocol = largeProtocol();
  protocol.session.resume = ResumePolicy::RestartBlock;
  protocol.parts = {protocol.parts[2], protocol.parts[2]};
  protocol.parts[1].name = "again";
  ScriptedFrontEnd first(protocol), second(protocol);
  first.screenResult = [](const Screen& screen) {
    ScreenResult result;
    result.answers = {{"consent", true}};
    if (screen.kind == Screen::Kind::Break) result.outcome = Outcome::Paused;
    return result;
  };
  EXPECT_EQ(run(protocol, first).kind, Step::Kind::Screen);
  EXPECT_EQ(resume(protocol, second).trialsAnswered, 8);
  EXPECT_THAT(second.log,
              ElementsAre("break", "instructions", "block_start", "4.0", "5.0", "6.0", "7.0", "debrief"));
  for (const store::StudyTrial& trial : store::readTrials(request_.store, 1)) EXPECT_FALSE(trial.superseded);
}

TEST_F(SessionStoreTest, AKnownSessionIsRefusedWithTheNextFreeName) {
  const Protocol protocol = smallProtocol(2, 0);
  ScriptedFrontEnd frontEnd(protocol);
  run(protocol, frontEnd);
  EXPECT_THAT(
      errorOf([&] { run(protocol, frontEnd); }),
      AllOf(HasSubstr("participant p01 has a session 1 already (finished)"), HasSubstr("--session 2")));
  EXPECT_THAT(errorOf([&] { resume(protocol, frontEnd); }),
              AllOf(HasSubstr("session 1 of participant p01 has finished"), HasSubstr("--session 2")));
  request_.resume = false;
  request_.session = "2";
  EXPECT_EQ(run(protocol, frontEnd).kind, Step::Kind::Finished);
  EXPECT_THAT(errorOf([&] { run(protocol, frontEnd); }), HasSubstr("--session 3"));
  request_.session = "9";
  EXPECT_THAT(errorOf([&] { resume(protocol, frontEnd); }),
              AllOf(HasSubstr("has no session 9"), HasSubstr("known sessions: 1, 2")));
  request_.participant = "p77";
  EXPECT_THAT(errorOf([&] { resume(protocol, frontEnd); }), HasSubstr("leave out --resume"));
}

TEST_F(SessionStoreTest, AnotherProtocolOrDisplayIsRefusedWithBothNamed) {
  const Protocol protocol = smallProtocol(4, 0);
  ScriptedFrontEnd first(protocol), second(protocol);
  dieAt(first, 1);
  EXPECT_THROW(run(protocol, first), Killed);
  Protocol other = smallProtocol(5, 0);
  other.name = "other";
  EXPECT_THAT(errorOf([&] { resume(other, second); }), AllOf(HasSubstr("'small', SHA-256 " + protocol.hash),
                                                             HasSubstr("'other', SHA-256 " + other.hash)));
  const perception::DisplayProfile display = request_.display;
  request_.display = perception::displayPreset("schwarz_2009");
  EXPECT_THAT(errorOf([&] { resume(protocol, second); }),
              AllOf(HasSubstr("'desktop_24', SHA-256 " + display.hash()),
                    HasSubstr("'schwarz_2009', SHA-256 " + request_.display.hash())));
  request_.display = display;
  EXPECT_EQ(resume(protocol, second).kind, Step::Kind::Finished);
}

TEST_F(SessionStoreTest, AnOldSessionOrOneThatMayNotBeResumedIsRefused) {
  Protocol protocol = smallProtocol(4, 0);
  protocol.session.maximumAgeH = 2.0;
  ScriptedFrontEnd first(protocol), second(protocol);
  dieAt(first, 1);
  EXPECT_THROW(run(protocol, first), Killed);
  clock_.pass(2.5 * 3600.0);
  EXPECT_THAT(errorOf([&] { resume(protocol, second); }),
              AllOf(HasSubstr("was left 2.5 h ago, the protocol allows 2 h"), HasSubstr("--session 2")));
  clock_.pass(-1.0 * 3600.0);
  Protocol strict = protocol;
  strict.session.resume = ResumePolicy::Refuse;
  EXPECT_THAT(errorOf([&] { resume(strict, second); }), HasSubstr("does not allow session 1"));
  EXPECT_EQ(resume(protocol, second).kind, Step::Kind::Finished);
}

TEST_F(SessionStoreTest, AClockThatWasSetIsNotedAndChangesNothingElse) {
  const Protocol protocol = smallProtocol(4, 0);
  ScriptedFrontEnd plain(protocol), jumping(protocol);
  run(protocol, plain);
  request_.session = "2";
  jumping.trialOutcome = [&](const Trial& trial, const Session&) {
    if (trial.number == 1) clock_.move(3600.0);
    if (trial.number == 2) clock_.move(-1800.0);
    if (trial.number == 3) clock_.move(1.5);  // within what a time server may do
    return Outcome::Done;
  };
  run(protocol, jumping);
  EXPECT_EQ(jumping.log, plain.log);
  std::vector<double> jumps;
  for (const store::StudyEvent& event : store::SessionReader(request_.store).events(2))
    if (event.kind == "clock_jump")
      jumps.push_back(event.data["wall_s"].get<double>() - event.data["monotonic_s"].get<double>());
  ASSERT_EQ(jumps.size(), 2U);
  EXPECT_NEAR(jumps[0], 3600.0, 0.01);
  EXPECT_NEAR(jumps[1], -1800.0, 0.01);
  EXPECT_EQ(warnings_.size(), 2U);
  EXPECT_THAT(warnings_[0], HasSubstr("the wall clock moved by 3600.0 s"));
  EXPECT_THAT(verify(protocol), IsEmpty());
}

TEST_F(SessionStoreTest, ClocksOfDifferentBootsAreNotCompared) {
  const Protocol protocol = smallProtocol(4, 0);
  ScriptedFrontEnd first(protocol), second(protocol);
  dieAt(first, 1);
  EXPECT_THROW(run(protocol, first), Killed);
  clock_.move(600.0);
  clock_.boot_ = "another";
  resume(protocol, second);
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(SessionStoreTest, ASessionFromTheFutureCountsAsNew) {
  Protocol protocol = smallProtocol(4, 0);
  protocol.session.maximumAgeH = 1.0;
  ScriptedFrontEnd first(protocol), second(protocol);
  dieAt(first, 1);
  EXPECT_THROW(run(protocol, first), Killed);
  clock_.move(-86400.0);
  clock_.boot_ = "another";
  EXPECT_EQ(resume(protocol, second).kind, Step::Kind::Finished);
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_THAT(warnings_[0], HasSubstr("age counts as 0"));
  const std::vector<store::StudyEvent> events = store::SessionReader(request_.store).events(1);
  for (const store::StudyEvent& event : events)
    if (event.kind == "continued") {
      EXPECT_EQ(event.data["gap_s"], 0.0);
    }
}

TEST_F(SessionStoreTest, ASessionThatALivingProcessHoldsIsRefused) {
  const Protocol protocol = smallProtocol(4, 0);
  ScriptedFrontEnd first(protocol), second(protocol);
  dieAt(first, 1);
  EXPECT_THROW(run(protocol, first), Killed);
  // This test's parent lives, and its identity is this process' with other numbers.
  const std::string parent = std::to_string(getppid());
  std::ifstream stat("/proc/" + parent + "/stat");
  std::string text{std::istreambuf_iterator<char>(stat), {}};
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string start;
  for (int i = 3; i <= 22; ++i) fields >> start;
  const std::string self = processIdentity();
  const std::string host = self.substr(0, self.find(':'));
  sql(request_.store, "UPDATE session SET owner = '" + host + ":" + parent + ":" + start + "'");
  EXPECT_THAT(errorOf([&] { resume(protocol, second); }),
              AllOf(HasSubstr("is being run by another process"), HasSubstr(host + ":" + parent)));
  sql(request_.store, "UPDATE session SET owner = '" + host + ":" + parent + ":1'");  // long dead
  EXPECT_EQ(resume(protocol, second).kind, Step::Kind::Finished);
}

TEST_F(SessionStoreTest, ATakenSessionIsNotWrittenOn) {
  const Protocol protocol = smallProtocol(4, 0);
  ScriptedFrontEnd frontEnd(protocol);
  frontEnd.trialOutcome = [&](const Trial& trial, const Session&) {
    if (trial.number == 1) sql(request_.store, "UPDATE session SET owner = 'elsewhere:1:1'");
    return Outcome::Done;
  };
  EXPECT_THAT(errorOf([&] { run(protocol, frontEnd); }), HasSubstr("no longer held by this process"));
  EXPECT_EQ(store::SessionReader(request_.store).events(1).back().kind, "trial_started");
}

TEST_F(SessionStoreTest, ChangedStimuliAreNoticedOnResuming) {
  const Protocol protocol = largeProtocol();
  ScriptedFrontEnd first(protocol), second(protocol);
  int shown = 0;
  first.trialOutcome = [&](const Trial&, const Session&) -> Outcome {
    if (shown++ == 9) throw Killed();
    return Outcome::Done;
  };
  EXPECT_THROW(run(protocol, first), Killed);
  Protocol changed = protocol;  // as if a scene had changed its version: same text, other stimuli
  for (FactorLevel& level : changed.parts[0].factors[0].levels) level.variables["distance"] = 7;
  EXPECT_THAT(errorOf([&] { resume(changed, second); }),
              AllOf(HasSubstr("shown with different stimuli"),
                    HasSubstr("use the version that started the session")));
}

TEST_F(SessionStoreTest, VerificationFindsRowsThatWereChangedByHand) {
  const Protocol protocol = smallProtocol(4, 0);
  ScriptedFrontEnd frontEnd(protocol);
  run(protocol, frontEnd);
  ASSERT_THAT(verify(protocol), IsEmpty());
  EXPECT_EQ(sql(request_.store,
                "DROP TRIGGER response_update; UPDATE response SET reaction_time_s = 0.25 "
                "WHERE trial = 2"),
            "");
  EXPECT_THAT(verify(protocol),
              ElementsAre(AllOf(HasSubstr("trial 1: response: reaction_time_s: the store has 0.25"))));
  EXPECT_EQ(sql(request_.store,
                "DROP TRIGGER frame_log_delete; DELETE FROM frame_log WHERE trial = 4 AND frame = 1"),
            "");
  EXPECT_THAT(verify(protocol).back(), HasSubstr("frame log of trial 3: count: the store has 2"));
  EXPECT_EQ(sql(request_.store,
                "DROP TRIGGER event_update; UPDATE event SET data = replace(data, '\"attempt\":0', "
                "'\"attempt\":1') WHERE number = 5"),
            "");
  EXPECT_THAT(errorOf([&] { verify(protocol); }), HasSubstr("the session's log is damaged"));
}

}  // namespace
}  // namespace limen::study
