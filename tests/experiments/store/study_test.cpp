// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/process.h"
#include "experiments/store/predictions.h"

#include "tests/experiments/store/store_fixture.h"

namespace limen::embedded {
extern const char* const kStoreSchema;
}

namespace limen::store {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kUtc = "2026-01-31T12:00:00.000Z";

StudyEntry entry(int number, const std::string& kind) {
  StudyEntry out;
  out.event = {number, kind, kUtc, 1000 + number, {{"n", number}}};
  return out;
}

StudyTrial trialOf(int number, int event) {
  StudyTrial trial;
  trial.number = number;
  trial.event = event;
  trial.part = "part";
  trial.condition = {{"distance", "near"}};
  trial.stimuli = {{{"scene", "a"}}, {{"scene", "b"}}};
  trial.stimulusHashes = {"aa", "bb"};
  trial.procedure = 3;
  trial.procedureStimulus = {0.1, 1e-300};
  trial.target = 1;
  trial.seed = 18446744073709551615u;
  trial.startedUtc = kUtc;
  return trial;
}

int64_t startSession(SessionLog& log, const std::string& participant, const std::string& name = "1") {
  StudySession session;
  session.participant = participant;
  session.name = name;
  session.participantNumber = log.participantNumber(participant, kUtc);
  session.seed = 18446744073709551557u;
  session.programVersion = "0.1.0";
  session.started = kUtc;
  return log.start(session, {"hash", "protocol", "p.yaml", "A title", "title: A title"},
                   {"display", "desk", "name: desk", {{"by", "colorimeter"}}}, {"gpu", false, {{"cpu", "x"}}},
                   {{0, "part", "part: practice", true, 2}, {1, "part", "part", false, 5}},
                   {entry(0, "started")});
}

/// Runs SQL past the log; what SQLite answers.
std::string attempt(const std::string& file, const std::string& sql) {
  sqlite3* database = nullptr;
  sqlite3_open(file.c_str(), &database);
  sqlite3_exec(database, "PRAGMA foreign_keys = ON", nullptr, nullptr, nullptr);
  char* message = nullptr;
  sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &message);
  const std::string out = message ? message : "done";
  sqlite3_free(message);
  sqlite3_close(database);
  return out;
}

/// A store with one session: a trial that was answered, and one that is on the screen.
void fill(const std::string& path) {
  SessionLog log(path);
  const int64_t id = startSession(log, "p01");
  StudyEntry began = entry(1, "trial_started");
  began.begun = trialOf(0, 1);
  log.append(id, {began});
  StudyEntry answered = entry(2, "answered");
  answered.ended = StudyTrialEnd{0, 0, true, "", StudyResponse(), {{0, 0, 0, 5, 0}, {0, 0, 1, 9, 2}}};
  answered.ended->response->event = 2;
  answered.ended->response->answer = "yes";
  answered.ended->response->outcome = 1;
  answered.ended->response->correct = true;
  answered.ended->response->severity = 2;
  answered.ended->response->reactionTimeS = 0.1 + 0.2;
  answered.ended->response->questionNs = 9007199254740993;
  answered.ended->response->device = "keyboard";
  answered.ended->response->extra = {{"p", 0.25}};
  StudyEntry next = entry(3, "trial_started");
  next.begun = trialOf(1, 3);
  next.note = StudyNote{3, "experimenter", "noise", {{"a", 1}}};
  next.form = nlohmann::json{{"age", "18-29"}};
  next.state = "paused";
  log.append(id, {answered, next});
}

TEST_F(StoreTest, WhatASessionWritesIsReadBackExactly) {
  fill(path("s.sqlite"));
  SessionReader reader(path("s.sqlite"));
  const std::vector<StudySession> sessions = reader.sessions();
  ASSERT_EQ(sessions.size(), 1U);
  const StudySession& session = sessions[0];
  EXPECT_EQ(session.participant, "p01");
  EXPECT_EQ(session.seed, 18446744073709551557u);
  EXPECT_EQ(session.state, "paused");
  EXPECT_EQ(session.owner, processIdentity());
  EXPECT_EQ(session.form, nlohmann::json({{"age", "18-29"}}));
  EXPECT_EQ(reader.protocol(session.protocol).text, "title: A title");
  EXPECT_EQ(reader.display(session.display).calibration, nlohmann::json({{"by", "colorimeter"}}));
  EXPECT_EQ(reader.environment(session.environment).device, "gpu");
  EXPECT_EQ(reader.events(session.id).size(), 4U);
  EXPECT_EQ(reader.events(session.id)[2].data, nlohmann::json({{"n", 2}}));
  EXPECT_EQ(reader.blocks(session.id)[1].trials, 5);
  EXPECT_EQ(reader.notes(session.id)[0].code, "noise");
  const std::vector<StudyTrial> trials = reader.trials(session.id, true);
  ASSERT_EQ(trials.size(), 2U);
  EXPECT_EQ(trials[0].seed, 18446744073709551615u);
  EXPECT_EQ(trials[0].procedureStimulus, (std::vector<double>{0.1, 1e-300}));
  EXPECT_EQ(trials[0].stimuli[1]["scene"], "b");
  EXPECT_TRUE(trials[0].counts());
  EXPECT_EQ(trials[0].response->reactionTimeS, 0.1 + 0.2);
  EXPECT_EQ(trials[0].response->questionNs, 9007199254740993);
  EXPECT_EQ(trials[0].response->severity, 2);
  EXPECT_FALSE(trials[0].response->confidence);
  EXPECT_EQ(trials[0].frames[1].missedBlanks, 2);
  EXPECT_FALSE(trials[1].valid);
  EXPECT_FALSE(trials[1].counts());
}

TEST_F(StoreTest, AStoreOfVersionOneIsMigratedWithItsRuns) {
  const std::string old = path("old.sqlite");
  rawSql(
      old,
      std::string(embedded::kStoreSchema) +
          "; PRAGMA application_id = 1279872334; PRAGMA user_version = 1;"
          "INSERT INTO experiment (hash, path, title, question, source, features, descriptor, report, "
          "created) "
          "VALUES ('h', 'd.yaml', 'T', 'Q', 'S', '[]', 'title: T', '{}', '2025-01-01T00:00:00.000Z');"
          "INSERT INTO environment (hash, device, software, facts) VALUES ('e', 'gpu', 0, '{}');"
          "INSERT INTO run (key, device, status, technique, scene, label, parameters, environment, started) "
          "VALUES ('k', 'gpu', 'done', 't', 's', 'l', '{\"a\": 1}', 1, '2025-01-01T00:00:00.000Z');"
          "INSERT INTO measurement (run, name, value, unit, kind) VALUES (1, 'rmse', 0.125, '', 'error');");
  // As it is, it can be read for its sweeps, and says what it lacks.
  EXPECT_EQ(Store(old, Access::ReadOnly).allRuns().size(), 1U);
  EXPECT_THAT(errorOf([&] { SessionReader reader(old); }),
              AllOf(HasSubstr("old.sqlite"), HasSubstr("no studies")));
  {
    SessionLog log(old);
    startSession(log, "p01");
  }
  EXPECT_EQ(rawSql(old, "PRAGMA user_version"), "3");
  EXPECT_EQ(rawSql(old, "PRAGMA integrity_check"), "ok");
  const std::vector<store::Run> runs = Store(old, Access::ReadOnly).allRuns();
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].measurements[0].value, 0.125);
  EXPECT_EQ(runs[0].parameters["a"], 1);
  EXPECT_EQ(readSessions(old).size(), 1U);
  // The migrated schema is that of a new store.
  fill(path("new.sqlite"));
  const std::string schema =
      "SELECT group_concat(sql, ';') FROM (SELECT sql FROM sqlite_schema ORDER BY name)";
  EXPECT_EQ(rawSql(old, schema), rawSql(path("new.sqlite"), schema));
}

TEST_F(StoreTest, FactsOfASessionAreNeverOverwritten) {
  const std::string store = path("s.sqlite");
  fill(store);
  for (const char* sql : {
           "UPDATE event SET data = '{}'",
           "DELETE FROM event WHERE number = 3",
           "INSERT OR REPLACE INTO event VALUES (1, 2, 'answered', 'x', 0, '{}')",
           "INSERT INTO event VALUES (1, 9, 'answered', 'x', 0, '{}')",
           "UPDATE response SET answer = 'no'",
           "DELETE FROM response",
           "INSERT OR REPLACE INTO response SELECT trial, event, 'no', outcome, correct, severity, "
           "confidence, "
           "reaction_time_s, question_ns, answered_ns, device, extra FROM response",
           "DELETE FROM frame_log",
           "UPDATE frame_log SET swap_ns = 1",
           "INSERT OR REPLACE INTO frame_log VALUES (1, 0, 0, 0, 77, 0)",
           "UPDATE trial SET stimuli = '[]'",
           "UPDATE trial SET seed = '1'",
           "UPDATE trial SET valid = 0 WHERE number = 0",
           "UPDATE trial SET reason = 'x' WHERE number = 0",
           "UPDATE trial SET superseded = 0",
           "DELETE FROM trial",
           "UPDATE session SET seed = '1'",
           "UPDATE session SET form = '{}'",
           "DELETE FROM session",
           "UPDATE participant SET code = 'x'",
           "DELETE FROM participant",
           "UPDATE protocol SET text = ''",
           "INSERT OR REPLACE INTO protocol VALUES ('hash', 'a', 'b', 'c', 'd')",
           "UPDATE display SET profile = ''",
           "INSERT OR REPLACE INTO display VALUES ('display', 'a', 'b', '{}')",
           "UPDATE block SET trials = 1",
           "INSERT OR REPLACE INTO block VALUES (1, 0, 'a', 'b', 0, 1)",
           "DELETE FROM note",
           "INSERT OR REPLACE INTO note VALUES (1, 3, 'a', 'b', '{}')",
       })
    EXPECT_THAT(attempt(store, sql), testing::AnyOf(HasSubstr("never overwritten"), HasSubstr("must follow"),
                                                    HasSubstr("end once")))
        << sql;
  // What a session does on its way stays possible.
  EXPECT_EQ(attempt(store, "UPDATE trial SET valid = 0, reason = 'late' WHERE number = 1"), "done");
  EXPECT_EQ(attempt(store, "UPDATE trial SET superseded = 1"), "done");
  EXPECT_EQ(attempt(store, "UPDATE session SET state = 'finished', owner = ''"), "done");
}

TEST_F(StoreTest, RowsOfASessionBelongToOneAnother) {
  const std::string store = path("s.sqlite");
  fill(store);
  for (const char* sql : {
           "INSERT INTO event VALUES (7, 0, 'started', 'x', 0, '{}')",
           "INSERT INTO note VALUES (1, 77, 'a', 'b', '{}')",
           "INSERT INTO frame_log VALUES (77, 0, 0, 0, 0, 0)",
           "INSERT INTO block VALUES (7, 0, 'a', 'b', 0, 1)",
           "INSERT INTO trial (session, number, attempt, event, part, block, condition, repetition, stimuli, "
           "stimulus_hashes, procedure_stimulus, target, change, practice, seed, started_utc) "
           "VALUES (1, 8, 0, 3, 'p', 44, '{}', 0, '[]', '[]', '[]', 0, 1, 0, '1', 'x')",
           "INSERT INTO session (participant, name, participant_number, protocol, display, environment, "
           "seed, "
           "program_version, started, state) VALUES ('nobody', '1', 0, 'hash', 'display', 1, '1', '', '', "
           "'running')",
       })
    EXPECT_THAT(attempt(store, sql), HasSubstr("FOREIGN KEY")) << sql;
}

TEST_F(StoreTest, ASecondSessionOfTheSameNameIsRefused) {
  SessionLog log(path("s.sqlite"));
  startSession(log, "p01");
  EXPECT_THAT(errorOf([&] { startSession(log, "p01"); }), HasSubstr("has a session 1 already"));
  startSession(log, "p01", "2");
  startSession(log, "p02");
  EXPECT_EQ(log.sessionNames("p01"), (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(log.participantNumber("p01", kUtc), 0);
  EXPECT_EQ(log.participantNumber("p02", kUtc), 1);
}

TEST_F(StoreTest, AFullDiskLosesTheEntryAndNothingBefore) {
  const std::string store = path("s.sqlite");
  SessionLog log(store);
  const int64_t id = startSession(log, "p01");
  log.limitPages(std::stoi(rawSql(store, "PRAGMA page_count")) + 4);
  int number = 1;
  const std::string error = errorOf([&] {
    for (; number < 1000; ++number) {
      StudyEntry began = entry(number, "trial_started");
      began.event.data["text"] = std::string(500, 'x');
      began.begun = trialOf(number, number);
      log.append(id, {began});
    }
  });
  EXPECT_THAT(
      error, AllOf(HasSubstr("s.sqlite"), HasSubstr("the disk is full"), HasSubstr("finished work is kept")));
  EXPECT_GT(number, 3);
  {
    SessionReader reader(store);
    EXPECT_EQ(reader.events(id).size(), static_cast<size_t>(number));
    EXPECT_EQ(reader.trials(id).size(), static_cast<size_t>(number) - 1);
  }
  log.limitPages(100000);
  StudyEntry again = entry(number, "paused");
  log.append(id, {again});
  EXPECT_EQ(SessionReader(store).events(id).size(), static_cast<size_t>(number) + 1);
  EXPECT_EQ(rawSql(store, "PRAGMA integrity_check"), "ok");
}

TEST_F(StoreTest, PredictionsComeBackAndAreNeverOverwritten) {
  const std::string store = path("s.sqlite");
  StudyPrediction first;
  first.stimulusHash = "aa";
  first.displayHash = "display";
  first.widthPx = 640;
  first.heightPx = 480;
  first.predictor = "popping";
  first.settings = {{"threshold", 0.005}};
  first.programVersion = "0.1.0";
  first.created = kUtc;
  first.figures = {{"rating", 1.0 / 3.0}, {"regions", {{{"size_px", 12}}}}};
  const StudyDisplay display{"display", "desk", "name: desk", nlohmann::json::object()};
  PredictionLog log(store);
  EXPECT_FALSE(log.has(first));
  EXPECT_TRUE(log.add(first, display));
  EXPECT_TRUE(log.has(first));
  StudyPrediction again = first;
  again.figures = {{"rating", 9.0}};
  EXPECT_FALSE(log.add(again, display));
  // Each part of the key tells predictions apart.
  again.widthPx = 641;
  EXPECT_TRUE(log.add(again, display));
  again = first, again.programVersion = "0.2.0";
  EXPECT_TRUE(log.add(again, display));
  again = first, again.settings = {{"threshold", 0.006}};
  EXPECT_TRUE(log.add(again, display));
  again = first, again.displayHash = "other";
  EXPECT_TRUE(log.add(again, {"other", "beamer", "name: beamer", nlohmann::json::object()}));

  const std::vector<StudyPrediction> read = readPredictions(store);
  ASSERT_EQ(read.size(), 5U);
  EXPECT_EQ(read[0].stimulusHash, "aa");
  EXPECT_EQ(read[0].widthPx, 640);
  EXPECT_EQ(read[0].heightPx, 480);
  EXPECT_EQ(read[0].settings, first.settings);
  EXPECT_EQ(read[0].figures, first.figures);
  EXPECT_EQ(read[0].created, kUtc);
  EXPECT_EQ(read[4].displayHash, "other");
  for (const std::string sql : {"UPDATE prediction SET figures = '{}'", "DELETE FROM prediction",
                                "INSERT OR REPLACE INTO prediction SELECT * FROM prediction LIMIT 1"})
    EXPECT_THAT(attempt(store, sql), HasSubstr("never overwritten")) << sql;
}

TEST_F(StoreTest, AStoreWithSessionsIsNotMergedIntoOneThatWouldLoseThem) {
  fill(path("s.sqlite"));
  Store target(path("t.sqlite"), Access::ReadWrite);
  EXPECT_THAT(errorOf([&] { target.merge(Store(path("s.sqlite"), Access::ReadOnly)); }),
              AllOf(HasSubstr("s.sqlite"), HasSubstr("1 session")));
}

}  // namespace
}  // namespace limen::store
