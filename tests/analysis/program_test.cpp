// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tests/analysis/synthetic_store.h"
#include "tests/run_program.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;

ProgramRun analyse(const std::string& arguments) { return runProgram("limen-analyse " + arguments); }

TEST(AnalyseProgram, WritesAReportAndSaysWhere) {
  const TemporaryFolder folder;
  {
    store::Store store(folder.path("s.sqlite"), store::Access::ReadWrite);
    store::Experiment experiment;
    experiment.title = "t";
    writeExperiment(store, experiment, {makeRun("a", "s", 1, {1}, 0.5)});
  }
  const ProgramRun outcome =
      analyse("report " + folder.path("s.sqlite") + " --json -o " + folder.path("out"));
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const nlohmann::json line = nlohmann::json::parse(outcome.text);
  EXPECT_EQ(line.at("event"), "report");
  EXPECT_EQ(line.at("runs"), 1);
  EXPECT_TRUE(std::filesystem::exists(line.at("page").get<std::string>()));
}

TEST(AnalyseProgram, RefusesBadInputWithCodeTwoAndOneLine) {
  const TemporaryFolder folder;
  {
    store::Store store(folder.path("s.sqlite"), store::Access::ReadWrite);
    store::Experiment experiment;
    experiment.title = "t";
    writeExperiment(store, experiment, {makeRun("a", "s", 1, {1}, 0.5)}, {{"k", "b", "s", ""}});
  }
  { const store::Store empty(folder.path("empty.sqlite"), store::Access::ReadWrite); }
  const std::pair<std::string, std::string> cases[] = {
      {"report " + folder.path("none.sqlite") + " -o " + folder.path("out"), "no such result store"},
      {"report " + folder.path("s.sqlite") + " -o " + folder.path("out"), "--force"},
      {"report " + folder.path("empty.sqlite") + " -o " + folder.path("out"), "no experiment"},
      {"report " + folder.path("s.sqlite") + " -o /proc/nowhere --force", "/proc/nowhere"},
      {"report " + folder.path("s.sqlite"), "--output"},
      {"reprot x", "reprot"},
      {"", "subcommand"}};
  for (const auto& [arguments, words] : cases) {
    const ProgramRun outcome = analyse(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.text, HasSubstr(words)) << arguments;
  }
}

TEST(AnalyseProgram, TellsItsVersionAndHelp) {
  EXPECT_EQ(analyse("--version").code, 0);
  EXPECT_THAT(analyse("--version").text, HasSubstr("limen-analyse "));
  EXPECT_THAT(analyse("report --help").text, HasSubstr("--force"));
}

}  // namespace
}  // namespace limen::analysis
