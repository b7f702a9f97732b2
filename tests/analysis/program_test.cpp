// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;

struct Outcome {
  int code = -1;
  std::string text;
};

Outcome analyse(const std::string& arguments) {
  Outcome outcome;
  FILE* pipe = popen((std::string(LIMEN_BIN_DIR "/limen-analyse ") + arguments + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer{};
  for (size_t n; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    outcome.text.append(buffer.data(), n);
  const int status = pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

TEST(AnalyseProgram, WritesAReportAndSaysWhere) {
  const TemporaryFolder folder;
  {
    store::Store store(folder.path("s.sqlite"), store::Access::ReadWrite);
    store::Experiment experiment;
    experiment.title = "t";
    writeExperiment(store, experiment, {makeRun("a", "s", 1, {1}, 0.5)});
  }
  const Outcome outcome = analyse("report " + folder.path("s.sqlite") + " --json -o " + folder.path("out"));
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
    const Outcome outcome = analyse(arguments);
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
