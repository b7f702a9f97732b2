// SPDX-License-Identifier: BSD-3-Clause
// `limen study sessions` and `replay` as a user calls them.
#include <sqlite3.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <sstream>

#include "experiments/base/catalogue.h"
#include "renderer/catalogue.h"
#include "tests/run_program.h"
#include "tests/study/session/session_fixture.h"

namespace limen::study {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class SessionsCommandTest : public SessionStoreTest {
 protected:
  static ProgramRun call(const std::string& arguments) { return runProgram("limen-study " + arguments); }
};

TEST_F(SessionsCommandTest, SessionsAreListedReplayedAndChecked) {
  const Protocol protocol = readProtocol("quick", catalogueFromRegistries());
  ScriptedFrontEnd frontEnd(protocol), paused(protocol);
  run(protocol, frontEnd);
  request_.participant = "p02";
  paused.trialOutcome = [](const Trial& trial, const Session&) {
    return trial.number == 4 ? Outcome::Paused : Outcome::Done;
  };
  run(protocol, paused);

  const ProgramRun listed = call("sessions " + request_.store + " --json");
  ASSERT_EQ(listed.code, 0) << listed.text;
  std::istringstream lines(listed.text);
  std::string line;
  std::getline(lines, line);
  const nlohmann::json first = nlohmann::json::parse(line);
  // Two distances with two changes and a catch trial each.
  EXPECT_EQ(first["participant"], "p01");
  EXPECT_EQ(first["state"], "finished");
  EXPECT_EQ(first["answered"], 6);
  EXPECT_EQ(first["planned"], 6);
  EXPECT_EQ(first["protocol"], "quick");
  std::getline(lines, line);
  const nlohmann::json second = nlohmann::json::parse(line);
  EXPECT_EQ(second["state"], "paused");
  EXPECT_EQ(second["answered"], 2);  // two of practice, then numbers 2 and 3
  EXPECT_EQ(second["invalid"], 1);
  EXPECT_THAT(call("sessions " + request_.store).text, AllOf(HasSubstr("p01"), HasSubstr("2/6")));

  const ProgramRun replayed = call("replay " + request_.store + " p01 --json");
  ASSERT_EQ(replayed.code, 0) << replayed.text;
  const nlohmann::json replay = nlohmann::json::parse(replayed.text);
  EXPECT_EQ(replay["verified"], true);
  ASSERT_EQ(replay["trials"].size(), frontEnd.trials.size());
  for (size_t i = 0; i < frontEnd.trials.size(); ++i) {
    const nlohmann::json& trial = replay["trials"][i];
    ASSERT_EQ(trial["stimuli"].size(), 1U);
    // From the log alone the very stimulus that was shown.
    EXPECT_EQ(stimulusHash(stimulusFromJson(trial["stimuli"][0])),
              stimulusHash(frontEnd.trials[i].stimuli[0]));
    EXPECT_EQ(trial["stimulus_hashes"][0], stimulusHash(frontEnd.trials[i].stimuli[0]));
    EXPECT_EQ(trial["seed"], std::to_string(frontEnd.trials[i].seed));
  }
  EXPECT_THAT(call("replay " + request_.store + " p02").text,
              AllOf(HasSubstr("invalid: paused"), HasSubstr("every row agrees with the events")));

  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(request_.store.c_str(), &database), SQLITE_OK);
  sqlite3_exec(database, "DROP TRIGGER response_update; UPDATE response SET answer = 'maybe' WHERE trial = 3",
               nullptr, nullptr, nullptr);
  sqlite3_close(database);
  const ProgramRun changed = call("replay " + request_.store + " p01");
  EXPECT_EQ(changed.code, 1);
  EXPECT_THAT(changed.text, AllOf(HasSubstr("some rows disagree"), HasSubstr("trial 2: response: answer")));
}

TEST_F(SessionsCommandTest, WhatIsNotThereIsNamed) {
  const Protocol protocol = readProtocol("quick", catalogueFromRegistries());
  ScriptedFrontEnd frontEnd(protocol);
  run(protocol, frontEnd);
  const auto refused = [&](const std::string& arguments, const std::string& text) {
    const ProgramRun called = call(arguments);
    EXPECT_EQ(called.code, 2) << called.text;
    EXPECT_THAT(called.text, HasSubstr(text));
  };
  refused("sessions " + path("none.sqlite"), "no such result store");
  refused("replay " + request_.store + " p10", "no participant 'p10'; did you mean 'p01'?");
  refused("replay " + request_.store + " p01 --session 2", "has no session '2'");
  request_.session = "2";
  run(protocol, frontEnd);
  refused("replay " + request_.store + " p01", "name one with --session: 1, 2");
}

}  // namespace
}  // namespace limen::study
