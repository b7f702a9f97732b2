// SPDX-License-Identifier: BSD-3-Clause
// Stores in which something stands that no program wrote there: every reader says in which file, table and
// row, and none goes on with it.
#include <sqlite3.h>

#include "tests/run_program.h"
#include "tests/study/session/session_fixture.h"

namespace limen::study {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

struct Damage {
  std::string name;
  std::string sql;
  std::string column;  ///< that the message names
};

std::string nameOf(const testing::TestParamInfo<Damage>& info) { return info.param.name; }

void execute(const std::string& file, const std::string& sql) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  char* error = nullptr;
  EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &error), SQLITE_OK) << error;
  sqlite3_close(database);
}

/// A store with two simulated sessions, made once.
const std::string& soundStore() {
  static const std::string file = [] {
    std::string pattern = (fs::temp_directory_path() / "limen_broken_XXXXXX").string();
    const std::string folder = mkdtemp(pattern.data());
    const std::string store = folder + "/sound.sqlite";
    const ProgramRun made = runProgram("limen-study simulate quick --observers 2 --quiet --store " + store);
    EXPECT_EQ(made.code, 0) << made.text;
    execute(store, "PRAGMA wal_checkpoint(TRUNCATE)");
    return store;
  }();
  return file;
}

class DamagedStore : public testing::TestWithParam<Damage> {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "limen_broken_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    store_ = (folder_ / "s.sqlite").string();
    fs::copy_file(soundStore(), store_);
    std::string triggers = "PRAGMA foreign_keys = OFF;";
    for (const char* name :
         {"event_update", "event_delete", "trial_update", "response_update", "session_update",
          "display_update", "protocol_update", "session_form", "trial_end", "block_update", "block_delete"})
      triggers += "DROP TRIGGER " + std::string(name) + ";";
    // As a disk or another program would do it, past all constraints.
    execute(store_, "PRAGMA ignore_check_constraints = ON;" + triggers + GetParam().sql);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
  std::string store_;
};

TEST_P(DamagedStore, IsRefusedByEveryReaderThatMeetsIt) {
  int met = 0;
  for (const std::string& call :
       {"limen-study sessions " + store_, "limen-study replay " + store_ + " S001",
        "limen-study export " + store_ + " -o " + (folder_ / "out").string(), "limen-analyse rates " + store_,
        "limen-analyse report " + store_ + " -o " + (folder_ / "page").string(),
        "limen-study simulate quick --observers 3 --quiet --store " + store_}) {
    const ProgramRun run = runProgram(call);
    EXPECT_THAT(run.code, AnyOf(0, 1, 2)) << call << "\n" << run.text;
    if (run.text.find("damaged") == std::string::npos) {
      EXPECT_EQ(run.text.find("exception"), std::string::npos) << call << "\n" << run.text;
      continue;
    }
    ++met;
    EXPECT_NE(run.code, 0) << call << "\n" << run.text;
    EXPECT_THAT(run.text, AllOf(HasSubstr("s.sqlite"), HasSubstr(GetParam().column))) << call;
  }
  EXPECT_GT(met, 0) << "nobody read it";
}

INSTANTIATE_TEST_SUITE_P(
    Of, DamagedStore,
    testing::Values(
        Damage{"NegativeVersion", "PRAGMA user_version = -1", "user_version"},
        Damage{"TrialBeginsAtNoEvent", "UPDATE trial SET event = 100000 WHERE id = 3",
               "table trial, column event"},
        Damage{"TrialBeginsBeforeAll", "UPDATE trial SET event = -5 WHERE id = 3",
               "table trial, column event"},
        Damage{"NoHashes", "UPDATE trial SET stimulus_hashes = '[]' WHERE id = 2",
               "table trial, column stimulus_hashes, row with id 2"},
        Damage{"HashesOfNumbers", "UPDATE trial SET stimulus_hashes = '[1]' WHERE id = 2", "stimulus_hashes"},
        Damage{"StimuliOfAnotherType", "UPDATE trial SET stimuli = '{}' WHERE id = 2", "stimuli"},
        Damage{"CutJson", "UPDATE trial SET condition = '{\"a\": ' WHERE id = 2", "condition"},
        Damage{"ConditionOfAnotherType", "UPDATE trial SET condition = '[]' WHERE id = 2", "condition"},
        Damage{"BlobForText", "UPDATE trial SET condition = x'00ff' WHERE id = 2", "condition"},
        Damage{"DeepJson",
               "UPDATE response SET extra = (WITH RECURSIVE r(n, s) AS (SELECT 0, '' UNION ALL SELECT n + 1, "
               "s || "
               "'[' FROM r WHERE n < 20000) SELECT s FROM r WHERE n = 20000)",
               "extra"},
        Damage{"TextForNumber", "UPDATE trial SET number = 'seven' WHERE id = 2",
               "table trial, column number"},
        Damage{"HugeNumber", "UPDATE trial SET repetition = 99999999999 WHERE id = 2", "repetition"},
        Damage{"NoFlag", "UPDATE trial SET change = 7 WHERE id = 2", "change"},
        Damage{"NoSeed", "UPDATE session SET seed = '12x'", "table session, column seed"},
        Damage{"SeedBeyondRange", "UPDATE session SET seed = '99999999999999999999999'", "seed"},
        Damage{"MissingEvent", "DELETE FROM event WHERE number = 3 AND session = 1", "table event"},
        Damage{"EventWithoutItsData", "UPDATE event SET data = '{}' WHERE number = 5 AND session = 1",
               "table event, number 5"},
        Damage{"EventOfAnotherType", "UPDATE event SET data = '[]' WHERE number = 5 AND session = 1",
               "table event"},
        Damage{"EventBeforeTheMachine",
               "UPDATE event SET monotonic_ns = -9223372036854775807 WHERE number = 5", "monotonic_ns"},
        Damage{"ProtocolWithoutItsEnd", "UPDATE protocol SET text = substr(text, 1, 60) || '\"'", "protocol"},
        Damage{"NoReactionTime", "UPDATE response SET reaction_time_s = 'soon'", "reaction_time_s"},
        Damage{"FactsOfAnotherType", "UPDATE environment SET facts = '3'", "table environment, column facts"},
        Damage{"FrontEndOfAnotherType", "UPDATE environment SET facts = '{\"front_end\": []}'", "front_end"}),
    nameOf);

}  // namespace
}  // namespace limen::study
