// SPDX-License-Identifier: BSD-3-Clause
// The rounds find what they look for.
#include "tests/fuzz/rounds.h"

#include <gmock/gmock.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "experiments/base/error.h"

namespace limen::fuzz {
namespace {

using testing::HasSubstr;

std::string contents(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// What five rounds of a reader find, which are alike.
Failure found(const std::function<void(const std::string&)>& read) {
  const Outcome outcome = runRounds(
      {.name = "planted", .extension = ".txt", .corpus = {"seed"}, .read = read, .secondsPerRound = 0.2}, 7,
      5);
  EXPECT_EQ(outcome.failures.size(), 5U);
  for (const Failure& failure : outcome.failures) std::filesystem::remove(failure.saved);
  return outcome.failures.empty() ? Failure{} : outcome.failures[0];
}

TEST(FuzzRounds, PlantedFaultsAreFound) {
  EXPECT_THAT(found([](const std::string&) { raise(SIGUSR1); }).what, HasSubstr("signal 10"));
  EXPECT_THAT(found([](const std::string&) {
                std::atomic<int> i = 0;
                while (i >= 0) i = 0;
              }).what,
              HasSubstr("longer"));
  EXPECT_THAT(found([](const std::string&) { throw std::bad_alloc(); }).what, HasSubstr("bad_alloc"));
  EXPECT_THAT(found([](const std::string&) { throw std::out_of_range("at"); }).what,
              HasSubstr("other than Error"));
  EXPECT_THAT(found([](const std::string&) { throw Error("wrong"); }).what, HasSubstr("does not name"));
  EXPECT_THAT(found([](const std::string& path) { throw Error(std::string(70000, 'a'), path); }).what,
              HasSubstr("bytes"));
  EXPECT_THAT(found([](const std::string&) { throw Violation{"not finite"}; }).what, HasSubstr("not finite"));
}

TEST(FuzzRounds, AFailingInputIsSavedAndItsSeedMakesItAgain) {
  const Parser parser{.name = "planted_by_length",  // saved inputs carry it: tests run side by side
                      .extension = ".txt",
                      .corpus = {"a: 1\nb: [2, 3]\n"},
                      .mutate = mutateYaml,
                      .read = [](const std::string& path) {
                        if (contents(path).size() % 3 == 0) raise(SIGSEGV);
                      }};
  const Outcome outcome = runRounds(parser, 1, 200);
  ASSERT_EQ(outcome.failures.size(), 5U);
  EXPECT_GT(outcome.read, 0);
  for (const Failure& failure : outcome.failures) {
    const std::string input = contents(failure.saved);
    EXPECT_EQ(input.size() % 3, 0U);
    std::filesystem::remove(failure.saved);
    const Outcome again = runRounds(parser, failure.seed, 1);
    ASSERT_EQ(again.failures.size(), 1U);
    EXPECT_EQ(contents(again.failures[0].saved), input);
    std::filesystem::remove(again.failures[0].saved);
  }
}

TEST(FuzzRounds, SeedsDiffer) {
  std::set<std::string> inputs;
  for (uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    inputs.insert(mutateYaml(random, "a: 1\nb: [2, {c: x}]\nd: some text\n", {"e: 5\n"}));
  }
  EXPECT_GT(inputs.size(), 80U);
}

}  // namespace
}  // namespace limen::fuzz
