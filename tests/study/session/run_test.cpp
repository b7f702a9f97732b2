// SPDX-License-Identifier: BSD-3-Clause
#include "tests/study/session/session_fixture.h"

namespace limen::study {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(SessionStoreTest, ASmallSessionIsStoredTrialByTrial) {
  const Protocol protocol = smallProtocol(6, 2);
  ScriptedFrontEnd frontEnd(protocol);
  const SessionEnd end = run(protocol, frontEnd);
  EXPECT_EQ(end.kind, Step::Kind::Finished);
  EXPECT_EQ(end.trialsAnswered, 8);
  EXPECT_EQ(end.trialsInvalid, 0);
  EXPECT_THAT(frontEnd.log, ElementsAre("instructions", "block_start", "0.0", "1.0", "2.0", "3.0", "4.0",
                                        "5.0", "6.0", "7.0", "debrief"));
  EXPECT_THAT(verify(protocol), IsEmpty());

  store::SessionReader reader(request_.store);
  const store::StudySession session = reader.sessions().at(0);
  EXPECT_EQ(session.seed, request_.seed);
  EXPECT_EQ(session.state, "finished");
  EXPECT_EQ(session.owner, "");
  EXPECT_EQ(session.participantNumber, 0);
  EXPECT_EQ(reader.protocol(session.protocol).text, protocol.text);
  EXPECT_EQ(reader.display(session.display).profile, perception::toYaml(request_.display));
  EXPECT_EQ(reader.environment(session.environment).facts["front_end"]["simulated"], true);
  const std::vector<store::StudyTrial> trials = reader.trials(session.id, true);
  ASSERT_EQ(trials.size(), 8U);
  int catches = 0;
  for (size_t i = 0; i < trials.size(); ++i) {
    EXPECT_EQ(trials[i].number, static_cast<int>(i));
    EXPECT_EQ(trials[i].seed, frontEnd.trials[i].seed);
    EXPECT_EQ(trials[i].stimulusHashes.at(0), stimulusHash(frontEnd.trials[i].stimuli.at(0)));
    EXPECT_EQ(trials[i].stimuli.at(0), toJson(frontEnd.trials[i].stimuli.at(0)));
    EXPECT_TRUE(trials[i].counts());
    // "yes" is right where there was a change.
    EXPECT_EQ(*trials[i].response->correct, (trials[i].response->answer == "yes") == trials[i].change);
    EXPECT_EQ(trials[i].response->outcome, trials[i].response->answer == "yes" ? 1 : 0);
    ASSERT_EQ(trials[i].frames.size(), 3U);
    EXPECT_EQ(trials[i].frames[2].swapNs, 2000000 + trials[i].number);
    EXPECT_EQ(trials[i].frames[2].missedBlanks, 1);
    catches += trials[i].change ? 0 : 1;
  }
  EXPECT_EQ(catches, 2);
}

TEST_F(SessionStoreTest, ALargeSessionHasItsCountsAndScreensInOrder) {
  const Protocol protocol = largeProtocol();
  ScriptedFrontEnd frontEnd(protocol);
  const SessionEnd end = run(protocol, frontEnd);
  EXPECT_EQ(end.kind, Step::Kind::Finished);
  EXPECT_THAT(verify(protocol), IsEmpty());
  std::vector<std::string> screens;
  for (const Screen& screen : frontEnd.screens) screens.push_back(toText(screen.kind));
  // Blocks of 8 trials with a break after every 5; then the pause between blocks and parts.
  EXPECT_THAT(screens, ElementsAre("consent", "form", "instructions", "practice_start", "practice_result",
                                   "block_start", "break", "break", "break", "break", "instructions",
                                   "block_start", "break", "instructions", "block_start", "debrief"));
  std::map<std::string, int> answered;
  store::SessionReader reader(request_.store);
  for (const store::StudyTrial& trial : reader.trials(1))
    if (trial.counts()) ++answered[trial.practice ? "practice" : trial.part];
  EXPECT_EQ(answered["practice"], 3);
  EXPECT_EQ(answered["direct"], 16);
  EXPECT_EQ(answered["rating"], 4);
  EXPECT_LE(answered["adaptive"], 24);
  EXPECT_EQ(end.trialsAnswered, answered["direct"] + answered["adaptive"] + answered["rating"]);
  // Progress ends at all, and never shows more done than there are.
  EXPECT_EQ(frontEnd.screens.back().trialsDone, frontEnd.screens.back().trialsInAll);
  for (const Screen& screen : frontEnd.screens) EXPECT_LE(screen.trialsDone, screen.trialsInAll);
  EXPECT_EQ(reader.sessions()[0].form, nlohmann::json({{"age", "18-29"}}));
}

TEST_F(SessionStoreTest, AProcedureThatEndsEarlyLeavesItsRemainingTrialsOut) {
  Protocol protocol = largeProtocol();
  protocol.parts = {protocol.parts[1]};
  ScriptedFrontEnd frontEnd(protocol);
  // Right, right, wrong, ...: a 2-down-1-up staircase turns at every second step, so that four reversals take
  // less than 12 trials.
  std::map<int, int> count;
  frontEnd.answer = [&](const Trial& trial) {
    const bool right = count[trial.plan.procedure]++ % 3 != 2;
    return answerIndex(protocol.parts[0], trial.plan, right);
  };
  const SessionEnd end = run(protocol, frontEnd);
  // Levels: 8, 8 (down), 6 wrong (up: first reversal), 8, 8 (second), ... : a reversal at trials 3, 5, 6, 8.
  EXPECT_EQ(end.trialsAnswered, 16);
  EXPECT_EQ(frontEnd.screens.front().trialsInAll, 24);
  EXPECT_EQ(frontEnd.screens.back().trialsInAll, 16);
  store::SessionReader reader(request_.store);
  std::map<int, std::vector<double>> levels;
  for (const store::StudyTrial& trial : reader.trials(1))
    levels[*trial.procedure].push_back(trial.procedureStimulus.at(0));
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_EQ(levels[0], levels[1]);
  EXPECT_EQ(levels[0].size(), 8U);
  EXPECT_EQ(levels[0][2], 6.0);
  EXPECT_THAT(verify(protocol), IsEmpty());
}

TEST_F(SessionStoreTest, AnInvalidTrialComesBackLaterAtTheSameLevelAndIsCountedOnce) {
  Protocol protocol = largeProtocol();
  protocol.parts = {protocol.parts[1]};
  ScriptedFrontEnd frontEnd(protocol);
  std::map<int, std::vector<double>> firstLevel;
  frontEnd.trialOutcome = [&](const Trial& trial, const Session&) {
    if (trial.attempt == 0) firstLevel[trial.number] = trial.procedureStimulus;
    return trial.attempt == 0 && trial.number % 4 == 1 ? Outcome::Invalid : Outcome::Done;
  };
  const SessionEnd end = run(protocol, frontEnd);
  EXPECT_GT(end.trialsInvalid, 0);
  EXPECT_THAT(verify(protocol), IsEmpty());
  for (size_t i = 1; i < frontEnd.trials.size(); ++i) {
    const Trial& trial = frontEnd.trials[i];
    if (trial.attempt == 0) continue;
    EXPECT_EQ(trial.procedureStimulus, firstLevel[trial.number]);
    EXPECT_NE(trial.seed, 0U);
  }
  store::SessionReader reader(request_.store);
  std::map<int, int> answers;
  for (const store::StudyTrial& trial : reader.trials(1)) {
    EXPECT_EQ(trial.valid, !(trial.attempt == 0 && trial.number % 4 == 1));
    if (!*trial.valid) {
      EXPECT_EQ(trial.reason, "as scripted");
      EXPECT_FALSE(trial.response);
    }
    answers[trial.number] += trial.counts() ? 1 : 0;
  }
  for (const auto& [number, count] : answers) EXPECT_LE(count, 1) << number;
}

TEST_F(SessionStoreTest, AnInvalidTrialIsNotShownAgainAtOnceAndSomewhereInItsBlock) {
  const Protocol protocol = smallProtocol(12, 0);
  std::map<int, int> distances;
  for (uint64_t seed = 0; seed < 40; ++seed) {
    ScriptedFrontEnd frontEnd(protocol);
    frontEnd.trialOutcome = [](const Trial& trial, const Session&) {
      return trial.number == 3 && trial.attempt == 0 ? Outcome::Invalid : Outcome::Done;
    };
    std::vector<Event> events;
    runInMemory(protocol, seed, 0, frontEnd, clock_, events);
    ASSERT_EQ(frontEnd.trials.size(), 13U);
    for (size_t i = 4; i < frontEnd.trials.size(); ++i)
      if (frontEnd.trials[i].number == 3) ++distances[static_cast<int>(i) - 3];
  }
  // Eight trials are left behind it: it comes back 2 to 9 places later, each equally likely.
  EXPECT_EQ(distances.begin()->first, 2);
  EXPECT_EQ(distances.rbegin()->first, 9);
  EXPECT_EQ(distances.size(), 8U);
}

TEST_F(SessionStoreTest, TheLastTrialComesBackAtTheEndAndIsLostAfterItsRepetitions) {
  Protocol protocol = smallProtocol(3, 0);
  protocol.session.repeatInvalidAtMost = 2;
  ScriptedFrontEnd frontEnd(protocol);
  frontEnd.trialOutcome = [](const Trial& trial, const Session&) {
    return trial.number == 2 ? Outcome::Invalid : Outcome::Done;
  };
  const SessionEnd end = run(protocol, frontEnd);
  EXPECT_THAT(frontEnd.log,
              ElementsAre("instructions", "block_start", "0.0", "1.0", "2.0", "2.1", "2.2", "debrief"));
  EXPECT_EQ(end.kind, Step::Kind::Finished);
  EXPECT_EQ(end.trialsAnswered, 2);
  EXPECT_EQ(end.trialsInvalid, 3);
  const std::vector<store::StudyNote> notes = store::SessionReader(request_.store).notes(1);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].author, "program");
  EXPECT_EQ(notes[0].code, "trial_lost");
  EXPECT_EQ(notes[0].detail["trial"], 2);
  EXPECT_THAT(verify(protocol), IsEmpty());
}

Protocol practiceProtocol(bool stop) {
  Protocol protocol = smallProtocol(2, 0);
  protocol.parts[0].practice = {4, true, 3, 2, stop, {}};
  return protocol;
}

TEST_F(SessionStoreTest, PracticeIsPassedInItsSecondRound) {
  const Protocol protocol = practiceProtocol(true);
  ScriptedFrontEnd frontEnd(protocol);
  frontEnd.answer = [&](const Trial& trial) {
    const bool first = trial.number < 4;  // two right in the first round, three in the second
    const bool right = first ? trial.number < 2 : trial.number < 9;
    return answerIndex(protocol.parts[0], trial.plan, right);
  };
  EXPECT_EQ(run(protocol, frontEnd).kind, Step::Kind::Finished);
  EXPECT_THAT(frontEnd.log, ElementsAre("instructions", "practice_start", "0.0", "right", "1.0", "right",
                                        "2.0", "wrong", "3.0", "wrong", "practice_result", "practice_start",
                                        "6.0", "right", "7.0", "right", "8.0", "right", "9.0", "wrong",
                                        "practice_result", "block_start", "4.0", "5.0", "debrief"));
  EXPECT_FALSE(frontEnd.screens[2].passed);
  EXPECT_TRUE(frontEnd.screens[4].passed);
  EXPECT_EQ(frontEnd.screens[4].trialsInAll, 2);
  EXPECT_THAT(verify(protocol), IsEmpty());
}

TEST_F(SessionStoreTest, FailedPracticeStopsTheSessionOrGoesOnWithANote) {
  for (const bool stop : {true, false}) {
    const Protocol protocol = practiceProtocol(stop);
    request_.session = stop ? "stop" : "on";
    ScriptedFrontEnd frontEnd(protocol);
    frontEnd.answer = [&](const Trial& trial) { return answerIndex(protocol.parts[0], trial.plan, false); };
    const SessionEnd end = run(protocol, frontEnd);
    store::SessionReader reader(request_.store);
    const std::vector<store::StudyEvent> events = reader.events(end.session);
    if (stop) {
      EXPECT_EQ(end.kind, Step::Kind::Aborted);
      EXPECT_EQ(frontEnd.log.back(), "practice_result");
      EXPECT_EQ(events.back().kind, "aborted");
      EXPECT_EQ(events.back().data["reason"], "practice failed");
      EXPECT_EQ(reader.sessions()[0].state, "aborted");
    } else {
      EXPECT_EQ(end.kind, Step::Kind::Finished);
      EXPECT_EQ(end.trialsAnswered, 2);
      ASSERT_EQ(reader.notes(end.session).size(), 1U);
      EXPECT_EQ(reader.notes(end.session)[0].code, "practice_failed");
    }
  }
}

TEST_F(SessionStoreTest, WithoutConsentNothingElseIsAsked) {
  const Protocol protocol = largeProtocol();
  ScriptedFrontEnd frontEnd(protocol);
  frontEnd.screenResult = [](const Screen&) { return ScreenResult(); };
  EXPECT_EQ(run(protocol, frontEnd).kind, Step::Kind::Aborted);
  EXPECT_THAT(frontEnd.log, ElementsAre("consent"));
  EXPECT_EQ(store::SessionReader(request_.store).events(1).back().data["reason"], "no consent");
}

TEST_F(SessionStoreTest, NotesOfTheExperimenterAndWhoStoppedAreStored) {
  const Protocol protocol = smallProtocol(3, 0);
  struct Noting : ScriptedFrontEnd {
    using ScriptedFrontEnd::ScriptedFrontEnd;
    std::vector<std::string> takeNotes() override { return std::exchange(taken, {}); }
    TrialResult present(const Trial& trial, const Session& session) override {
      TrialResult result = ScriptedFrontEnd::present(trial, session);
      if (trial.number == 1) taken = {"noise", "Jane was late"};
      if (trial.number != 2) return result;
      result.outcome = Outcome::Aborted;
      result.by = "experimenter";
      result.reason = "ended by the experimenter";
      return result;
    }
    std::vector<std::string> taken;
  } frontEnd(protocol);
  EXPECT_EQ(run(protocol, frontEnd).kind, Step::Kind::Aborted);
  store::SessionReader reader(request_.store);
  const std::vector<store::StudyNote> notes = reader.notes(1);
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_EQ(notes[0].code, "noise");
  EXPECT_EQ(notes[1].code, "other");  // not a code: what it says is nowhere
  EXPECT_EQ(notes[1].author, "experimenter");
  const store::StudyEvent last = reader.events(1).back();
  EXPECT_EQ(last.kind, "aborted");
  EXPECT_EQ(last.data["by"], "experimenter");
  EXPECT_EQ(reader.trials(1).back().valid, false);
  EXPECT_THAT(verify(protocol), IsEmpty());
}

TEST_F(SessionStoreTest, AnAnswerThatTheProtocolDoesNotHaveIsRefusedAndNotStored) {
  const Protocol protocol = smallProtocol();
  struct Wrong : ScriptedFrontEnd {
    using ScriptedFrontEnd::ScriptedFrontEnd;
    TrialResult present(const Trial& trial, const Session& session) override {
      TrialResult result = ScriptedFrontEnd::present(trial, session);
      result.answer->answer = "perhaps";
      return result;
    }
  } frontEnd(protocol);
  EXPECT_THAT(errorOf([&] { run(protocol, frontEnd); }),
              HasSubstr("'perhaps' is not an answer of part 'main'"));
  EXPECT_EQ(store::SessionReader(request_.store).events(1).back().kind, "trial_started");
  ScriptedFrontEnd right(protocol);
  EXPECT_EQ(resume(protocol, right).kind, Step::Kind::Finished);
}

}  // namespace
}  // namespace limen::study
