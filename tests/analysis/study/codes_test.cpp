// SPDX-License-Identifier: BSD-3-Clause
// Participants' codes in what analyses of a study print and write: only where they are asked for.
#include <gmock/gmock.h>
#include <sqlite3.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/analysis/synthetic_store.h"
#include "tests/run_program.h"

namespace limen::analysis {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// Simulated sessions, made into those of people with these codes.
void makePeople(const std::string& store) {
  const ProgramRun made = runProgram("limen-study simulate quick --observers 3 --quiet --store " + store);
  ASSERT_EQ(made.code, 0) << made.text;
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(store.c_str(), &database), SQLITE_OK);
  char* error = nullptr;
  EXPECT_EQ(
      sqlite3_exec(database,
                   "PRAGMA foreign_keys = OFF; DROP TRIGGER session_update; DROP TRIGGER participant_update;"
                   "UPDATE session SET participant = replace(participant, 'S00', 'keller-');"
                   "UPDATE participant SET code = replace(code, 'S00', 'keller-');"
                   "UPDATE environment SET facts = json_remove(facts, '$.front_end.simulated')",
                   nullptr, nullptr, &error),
      SQLITE_OK)
      << error;
  sqlite3_close(database);
}

/// Seeds of sessions and trials, by which a guessed code could be checked in stores of older versions.
std::vector<std::string> seedsOf(const std::string& store) {
  sqlite3* database = nullptr;
  sqlite3_open(store.c_str(), &database);
  std::vector<std::string> out;
  const auto collect = [](void* to, int, char** values, char**) {
    static_cast<std::vector<std::string>*>(to)->emplace_back(values[0]);
    return 0;
  };
  sqlite3_exec(database, "SELECT seed FROM session UNION SELECT seed FROM trial", collect, &out, nullptr);
  sqlite3_close(database);
  return out;
}

/// All that is in the files below a folder, except pictures.
std::string contentsBelow(const std::string& folder) {
  std::string out;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    out.append(std::istreambuf_iterator<char>(stream), {});
  }
  return out;
}

TEST(Codes, ResultsNameObserversByNumberUnlessCodesAreAskedFor) {
  const TemporaryFolder folder;
  const std::string store = folder.path("s.sqlite"), out = folder.path("out");
  makePeople(store);
  const std::vector<std::string> seeds = seedsOf(store);
  ASSERT_GT(seeds.size(), 10U);
  for (const auto& [command, options] :
       std::vector<std::pair<std::string, std::string>>{{"rates", ""},
                                                        {"anova", ""},
                                                        {"sdt", ""},
                                                        {"mixed", " --fixed distance"},
                                                        {"fit", " --by observer"},
                                                        {"correlate", ""},
                                                        {"report", ""}}) {
    for (const bool codes : {false, true}) {
      fs::remove_all(out);
      fs::create_directory(out);
      const bool report = command == "report";
      const std::string words = "limen-analyse " + command + " " + store + options + " --no-exclusions" +
                                (codes ? " --codes" : "") + (report ? " -o " + out + "/page" : "");
      const ProgramRun text = runProgram(words);
      ASSERT_EQ(text.code, 0) << text.text;
      std::string all = text.text + contentsBelow(out);
      if (!report) all += runProgram(words + " --json").text;
      if (!report && command.find("fit") != 0)
        all += runProgram(words + " --csv " + out + "/t.csv").text + contentsBelow(out);
      if (!codes) {
        EXPECT_THAT(all, Not(HasSubstr("keller-"))) << words;
        for (const std::string& seed : seeds) EXPECT_EQ(all.find(seed), std::string::npos) << words;
      }
      if (command == "rates" || command == "sdt" || report) {
        EXPECT_THAT(all, HasSubstr(codes ? "keller-2" : "O02")) << words;
      }
    }
  }
}

TEST(Codes, SimulatedObserversKeepTheirNames) {
  const TemporaryFolder folder;
  const std::string store = folder.path("s.sqlite");
  ASSERT_EQ(runProgram("limen-study simulate quick --observers 2 --quiet --store " + store).code, 0);
  EXPECT_THAT(runProgram("limen-analyse rates --json --no-exclusions " + store).text, HasSubstr("S002"));
}

}  // namespace
}  // namespace limen::analysis
