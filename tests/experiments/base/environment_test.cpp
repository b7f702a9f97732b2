// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/environment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

namespace limen {
namespace {

TEST(Environment, CommandsReadBackInAShell) {
  EXPECT_EQ(quoteCommand({"limen-sweep", "a b.yaml", "--store=x", "", "it's"}),
            "limen-sweep 'a b.yaml' --store=x '' 'it'\\''s'");
}

TEST(Environment, FactsAreCompleteAndNameNoFolderAboveTheTree) {
  const nlohmann::json facts = environmentFacts({"limen-sweep"}, std::filesystem::current_path().string());
  EXPECT_GT(facts["cores"].get<int>(), 0);
  EXPECT_GT(facts["memory_bytes"].get<int64_t>(), int64_t{1} << 26);
  EXPECT_EQ(facts["working_directory"], ".");
  EXPECT_THAT(facts["compiler"].get<std::string>(),
              testing::AnyOf(testing::HasSubstr("gcc"), testing::HasSubstr("clang")));
  EXPECT_TRUE(
      std::regex_match(facts["commit"].get<std::string>(), std::regex("unknown|[0-9a-f]{40}(-dirty)?")))
      << facts["commit"];
  EXPECT_TRUE(std::regex_match(facts["time"].get<std::string>(), std::regex("[0-9]{4}-.*T.*Z")));
  for (const char* library : {"yaml-cpp", "sqlite", "nlohmann-json", "fmt", "cli11"})
    EXPECT_TRUE(facts["libraries"].contains(library)) << library;
}

}  // namespace
}  // namespace limen
