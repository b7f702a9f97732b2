// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/run_program.h"

namespace limen {
namespace {

using nlohmann::json;
using testing::HasSubstr;

ProgramRun study(const std::string& arguments) { return runProgram("limen-study protocol " + arguments); }

TEST(ProtocolCommand, ListsAndShows) {
  const ProgramRun list = study("");
  EXPECT_EQ(list.code, 0);
  for (const char* name : {"experiment_1", "experiment_2", "threshold_2ifc", "quality_pairs", "quick"})
    EXPECT_THAT(list.text, HasSubstr(name));
  const ProgramRun quick = study("quick --participant-number 2 --seed 5");
  EXPECT_EQ(quick.code, 0);
  EXPECT_THAT(quick.text, HasSubstr("participant 2, seed 5: 6 trials"));
}

TEST(ProtocolCommand, JsonAgreesWithItself) {
  const ProgramRun output = study("quick --json --seed 5");
  ASSERT_EQ(output.code, 0) << output.text;
  const json shown = json::parse(output.text);
  EXPECT_EQ(shown["trials"], 6);
  EXPECT_EQ(study("quick --json --seed 5").text, output.text);
  EXPECT_NE(study("quick --json --seed 6").text, output.text);
  size_t trials = 0;
  for (const json& block : shown["blocks"]) trials += block["practice"] ? 0 : block["trials"].size();
  EXPECT_EQ(trials, 6U);
  EXPECT_EQ(shown["blocks"][0]["trials"][0]["stimulus_hashes"][0].get<std::string>().size(), 64U);
}

TEST(ProtocolCommand, ChecksFilesAndRefusesBadOnes) {
  EXPECT_EQ(study("quick experiment_1 --check").code, 0);
  const std::string bad = testing::TempDir() + "/bad_protocol.yaml";
  std::ofstream(bad) << "title: t\ntask: {type: yes_no, question: q}\n";
  const ProgramRun refused = study("--check " + bad);
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.text, HasSubstr("bad_protocol.yaml:1:1: 'question' is missing"));
  EXPECT_THAT(refused.text, HasSubstr("'stimulus' is missing"));
  const ProgramRun unknown = study("quik");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.text, HasSubstr("did you mean 'quick'?"));
  EXPECT_EQ(study("quick --participant-number -1").code, 2);
}

}  // namespace
}  // namespace limen
