// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/analysis/study/hand_made.h"
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
      {"reprot x", "reprot"},
      {"", "subcommand"}};
  for (const auto& [arguments, words] : cases) {
    const ProgramRun outcome = analyse(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.text, HasSubstr(words)) << arguments;
  }
}

TEST(AnalyseProgram, ReportsSweepsStudiesOrBoth) {
  const TemporaryFolder folder;
  const std::string path = folder.path("s.sqlite"), call = "report " + path + " --json -o ";
  addHandMadeSession(path, "p1", "task: {type: yes_no}\nfactors:\n  d: [near, far]\n",
                     trials({{"d", "near"}}, 1, 2) + trials({{"d", "far"}}, 1, 2));
  const auto linesOf = [](const ProgramRun& outcome) {
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    std::vector<nlohmann::json> out;
    std::istringstream lines(outcome.text);
    for (std::string line; std::getline(lines, line);) out.push_back(nlohmann::json::parse(line));
    return out;
  };
  const auto study = linesOf(analyse(call + folder.path("study")));
  ASSERT_EQ(study.size(), 1U);
  EXPECT_EQ(study[0].at("page"), folder.path("study/report.html"));
  EXPECT_EQ(study[0].at("observers"), 1);
  EXPECT_EQ(study[0].at("answers"), 4);
  EXPECT_EQ(study[0].at("simulated"), false);
  {
    store::Store store(path, store::Access::ReadWrite);
    store::Experiment experiment;
    experiment.title = "sweep";
    writeExperiment(store, experiment, {makeRun("a", "s", 1, {1}, 0.5)});
  }
  const auto both = linesOf(analyse(call + folder.path("both")));
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].at("title"), "By hand");
  EXPECT_EQ(both[1].at("title"), "sweep");
  for (const nlohmann::json& line : both) {
    const std::filesystem::path page = line.at("page").get<std::string>();
    EXPECT_TRUE(std::filesystem::exists(page));
    EXPECT_EQ(page.parent_path().parent_path(), folder.path("both"));
  }
  const auto chosen = linesOf(analyse(call + folder.path("chosen") + " --no-exclusions"));
  ASSERT_EQ(chosen.size(), 1U);
  EXPECT_EQ(chosen[0].at("page"), folder.path("chosen/report.html"));
  EXPECT_EQ(linesOf(analyse(call + folder.path("sweep") + " --experiment sweep")).at(0).at("runs"), 1);

  for (const auto& [arguments, words] :
       {std::pair<std::string, std::string>{" --protocol hand_maid", "hand_made"},
        {" --observers simulated", "no finished session"},
        {" --observers dogs", "--observers"}}) {
    const ProgramRun outcome = analyse(call + folder.path("refused") + arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr(words));
    EXPECT_FALSE(std::filesystem::exists(folder.path("refused")));
  }
}

TEST(AnalyseProgram, TellsItsVersionAndHelp) {
  EXPECT_EQ(analyse("--version").code, 0);
  EXPECT_THAT(analyse("--version").text, HasSubstr("limen-analyse "));
  EXPECT_THAT(analyse("report --help").text, HasSubstr("--force"));
}

}  // namespace
}  // namespace limen::analysis
