// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/store/sessions.h"
#include "study/observers/simulate.h"
#include "study/observers/simulated_front_end.h"
#include "study/observers/summary.h"
#include "tests/study/observers/binomial.h"
#include "tests/study/observers/example.h"

namespace limen::study {
namespace {

const std::string kSimulation =
    "simulation: {variable: distance, direction: falling, threshold: 7, width: 6, guess: 0.1, lapse: 0.04,\n"
    "             between_observers: {threshold_sd_log: 0.3}}\n";

SimulationRequest requestFor(const Protocol& protocol, const std::string& store, int observers) {
  SimulationRequest request;
  request.store = store;
  request.observers = observers;
  request.observer = chooseObserver("lapsing");
  request.display = perception::readDisplay(protocol.display);
  return request;
}

// All that was stored of a session's answers, with their simulated times.
std::vector<std::string> answersIn(const std::string& path) {
  const store::SessionReader reader(path);
  std::vector<std::string> out;
  for (const store::StudySession& session : reader.sessions())
    for (const store::StudyTrial& trial : reader.trials(session.id)) {
      if (!trial.response) continue;
      out.push_back(session.participant + " " + std::to_string(session.participantNumber) + " " +
                    std::to_string(trial.number) + " " + trial.response->answer + " " +
                    std::to_string(trial.response->reactionTimeS) + " " + trial.response->extra.dump());
    }
  std::sort(out.begin(), out.end());
  return out;
}

std::string logIn(const std::string& path) {
  const store::SessionReader reader(path);
  std::string out;
  for (const store::StudySession& session : reader.sessions())
    for (store::StudyEvent event : reader.events(session.id)) {
      event.data.erase("environment");  // names the machine's process
      out += event.kind + " " + event.utc + " " + std::to_string(event.monotonicNs) + " " +
             event.data.dump() + "\n";
    }
  return out;
}

TEST(SimulatedClock, TellsTimeThatHasPassed) {
  SimulatedClock clock(1582934399500);  // date -u -d @1582934399
  EXPECT_EQ(clock.utc(), "2020-02-28T23:59:59.500Z");
  clock.advance(0.5);
  EXPECT_EQ(clock.utc(), "2020-02-29T00:00:00.000Z");
  clock.advance(86400.0);
  EXPECT_EQ(clock.utc(), "2020-03-01T00:00:00.000Z");
  EXPECT_EQ(clock.monotonicNs(), 86400500000000);
  EXPECT_EQ(utcMilliseconds("2020-02-28T23:59:59.500Z"), 1582934399500);
  EXPECT_THROW(utcMilliseconds("yesterday"), Error);
}

TEST(SimulatedSessions, TheSameSeedGivesTheSameBytes) {
  const Protocol protocol = boxProtocol(kYesNo + kSimulation);
  TemporaryStore first, second, other;
  simulateSessions(protocol, requestFor(protocol, first.path, 3));
  SimulationRequest request = requestFor(protocol, second.path, 3);
  request.jobs = 3;
  simulateSessions(protocol, request);
  EXPECT_EQ(logIn(first.path), logIn(second.path));
  request.store = other.path;
  request.seed = 2;
  simulateSessions(protocol, request);
  EXPECT_NE(answersIn(first.path), answersIn(other.path));
}

TEST(SimulatedSessions, StoppedOnesGoOnWithTheSameAnswers) {
  const Protocol protocol = boxProtocol(kYesNo + kSimulation);
  TemporaryStore whole, broken;
  simulateSessions(protocol, requestFor(protocol, whole.path, 4));
  SimulationRequest request = requestFor(protocol, broken.path, 4);
  // A session has 6 trials and some screens: stops within the second one, then within the third.
  int steps = 0;
  request.progress = [&steps](int64_t, int) { return ++steps == 12; };
  const SimulationEnd first = simulateSessions(protocol, request);
  EXPECT_TRUE(first.stopped);
  steps = 0;
  EXPECT_TRUE(simulateSessions(protocol, request).stopped);
  request.progress = nullptr;
  const SimulationEnd last = simulateSessions(protocol, request);
  EXPECT_FALSE(last.stopped);
  EXPECT_GT(last.skipped, 0);
  EXPECT_EQ(answersIn(whole.path), answersIn(broken.path));
  // Nothing is left to do.
  EXPECT_EQ(simulateSessions(protocol, request).skipped, 4);
}

TEST(SimulatedSessions, OthersInTheStoreAreNotTakenForTheirs) {
  const Protocol protocol = boxProtocol(kYesNo + kSimulation);
  TemporaryStore store;
  simulateSessions(protocol, requestFor(protocol, store.path, 2));
  SimulationRequest request = requestFor(protocol, store.path, 2);
  request.seed = 5;
  EXPECT_THROW(simulateSessions(protocol, request), Error);
  request = requestFor(protocol, store.path, 2);
  request.observer = chooseObserver("ideal");
  EXPECT_THROW(simulateSessions(protocol, request), Error);
  const Protocol changed = boxProtocol(kYesNo + kSimulation + "# changed\n");
  EXPECT_THROW(simulateSessions(changed, requestFor(changed, store.path, 2)), Error);
  request.prefix = "T";
  EXPECT_EQ(simulateSessions(protocol, request).newSessions, 2);
}

TEST(SimulatedSessions, DisturbedShowingsAreAskedAgain) {
  const Protocol protocol = boxProtocol(kYesNo + kSimulation);
  TemporaryStore store;
  SimulationRequest request = requestFor(protocol, store.path, 20);
  request.invalidRate = 0.2;
  simulateSessions(protocol, request);
  const SimulationSummary summary = summarise(protocol, store.path, request.observer.behaviour, "S");
  EXPECT_EQ(summary.finished, 20);
  // Each showing is invalid with 0.2 up to the trial's fourth; of some 150 showings about 30 are.
  EXPECT_TRUE(isRate(summary.invalid, summary.invalid + summary.trials, 0.2));
  EXPECT_GE(summary.trials, 20 * 6 - 1);
}

TEST(SimulatedSessions, TheAnswerOfTheObserverIsTheOutcomeOfTheSession) {
  // respond() and Session::outcomeOf() must not differ in what counts as 1.
  for (const std::string task :
       {"{type: yes_no, question: A}", "{type: interval, alternatives: 2, question: A, answers: [x, y]}",
        "{type: rating, question: A, answers: [x, y, z]}"}) {
    const bool catches = task.find("interval") == std::string::npos;
    const Protocol protocol = boxProtocol("task: " + task + R"(
factors: {distance: [4, 10]}
stimulus:
  scene: {name: box, distance: = distance}
  levels: {before: 1, after: 0}
trials: {change: 4, catch: )" + (catches ? "2" : "0") +
                                          "}\n" + kSimulation);
    const Simulation simulation(protocol);
    SimulatedObserver observer(simulation, chooseObserver("lapsing").behaviour, 3);
    for (const PlannedBlock& block : makeDesign(protocol, 4, 0).blocks)
      for (const PlannedTrial& planned : block.trials) {
        Trial trial;
        trial.plan = planned;
        trial.seed = static_cast<uint64_t>(planned.number);
        const ObserverResponse response = observer.respond(trial);
        EXPECT_EQ(response.outcome, Session::outcomeOf(protocol.parts[0], planned, response.answer));
      }
  }
}

// Observers drawn from QUEST's own prior: its intervals then hold the truth as often as they say.
TEST(SimulatedSessions, QuestRecoversThresholdsWithinItsIntervals) {
  const Protocol protocol = boxProtocol(R"(
task: {type: interval, alternatives: 2, question: "Which?", answers: [first, second]}
stimulus:
  scene: {name: box, distance: = 10 + size}
  levels: {before: 1, after: 0}
procedure:
  type: quest
  stimulus: {name: size, minimum: -2.5, maximum: 2.5}
  threshold_guess: 0
  threshold_guess_sd: 0.5
  threshold_probability: 0.812899697 # F = 1 - 1/e: 1 - lapse - (0.5 - lapse)/e with a lapse of 0.005
  beta: 3.5
  delta: 0.01
  gamma: 0.5
  range: 5
  stop: {trials: 30}
simulation:
  variable: size
  sigmoid: gumbel
  level: 0.6321205588
  threshold: 0
  slope: 2.9647
  lapse: 0.005
  between_observers: {threshold_sd: 0.5}
)");
  TemporaryStore store;
  const SimulationRequest request = requestFor(protocol, store.path, 60);
  simulateSessions(protocol, request);
  const SimulationSummary summary = summarise(protocol, store.path, request.observer.behaviour, "S");
  ASSERT_EQ(summary.estimates.size(), 1u);
  const EstimateSummary& estimate = summary.estimates[0];
  EXPECT_EQ(estimate.participants, 60);
  EXPECT_TRUE(isRate(static_cast<int>(std::lround(60 * estimate.coverage)), 60, 0.95));
  EXPECT_NEAR(estimate.bias, 0.0, 5.0 * estimate.rms / std::sqrt(60.0));
  EXPECT_LT(estimate.rms, 0.25);
}

}  // namespace
}  // namespace limen::study
