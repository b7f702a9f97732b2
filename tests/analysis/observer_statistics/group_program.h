// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/analysis/synthetic_store.h"
#include "tests/run_program.h"

namespace limen::analysis {

/// Runs `limen-analyse` on the tables of reference/, whose expected values are those of reference/groups.R,
/// and on tables that a test writes.
class GroupProgram : public testing::Test {
 protected:
  using json = nlohmann::json;

  static std::string reference(const std::string& name) {
    return LIMEN_SOURCE_DIR "/tests/analysis/observer_statistics/reference/" + name;
  }
  std::string write(const std::string& text, const std::string& name = "table.csv") {
    std::ofstream(folder_.path(name)) << text;
    return folder_.path(name);
  }
  static json analyse(const std::string& arguments) {
    const ProgramRun run = runProgram("limen-analyse " + arguments + " --json");
    EXPECT_EQ(run.code, 0) << run.text;
    return run.code == 0 ? json::parse(run.text) : json();
  }
  static void refuses(const std::string& arguments, const std::vector<std::string>& parts) {
    const ProgramRun run = runProgram("limen-analyse " + arguments);
    EXPECT_EQ(run.code, 2) << run.text;
    for (const std::string& part : parts) EXPECT_THAT(run.text, testing::HasSubstr(part)) << arguments;
  }
  static void expectNear(const json& value, double expected, double tolerance = 1e-9) {
    ASSERT_TRUE(value.is_number()) << value << " for " << expected;
    EXPECT_NEAR(value.get<double>(), expected, tolerance * std::max(1.0, std::abs(expected)));
  }
  /// Simulates experiment_1 into `store` and exports it; the path of the table of trials.
  std::string exportedStudy(const std::string& store, const std::string& observersAndSeed) const {
    const ProgramRun simulated =
        runProgram("limen-study simulate experiment_1 " + observersAndSeed + " --quiet --store " + store);
    EXPECT_EQ(simulated.code, 0) << simulated.text;
    const std::string folder = folder_.path("out");
    const ProgramRun exported = runProgram("limen-study export " + store + " -o " + folder + " --codes");
    EXPECT_EQ(exported.code, 0) << exported.text;
    for (const auto& file : std::filesystem::recursive_directory_iterator(folder))
      if (file.path().filename() == "trials.csv") return file.path().string();
    ADD_FAILURE() << "no trials.csv in " << folder;
    return {};
  }

  const TemporaryFolder folder_;
};

}  // namespace limen::analysis
