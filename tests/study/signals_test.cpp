// SPDX-License-Identifier: BSD-3-Clause
// What Ctrl-C and `kill` do to programs that are in the middle of long work.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/stopped_program.h"

namespace limen {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Signals : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "limen_signals_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// A second is promised; the rest is for machines with other work to do and for sanitizers. Whatever does not
  /// hear the signal takes longer still.
  static constexpr double kSeconds = 10.0;

  void expectPromptEnd(const std::vector<std::string>& words, const std::function<bool()>& ready) {
    const StoppedRun run = stopProgram(words, folder_.string(), GetParam(), ready);
    EXPECT_EQ(run.code, 128 + GetParam()) << run.text;
    EXPECT_LT(run.seconds, kSeconds) << run.text;
    EXPECT_THAT(run.text, Not(HasSubstr("terminate")));
  }

  /// Rows of answers are there: whoever writes them is at work.
  std::function<bool()> grows(const std::string& name) const {
    return [path = folder_ / name] {
      std::error_code none;
      return fs::exists(path.string() + "-wal", none) &&
             fs::file_size(path.string() + "-wal", none) > 200'000;
    };
  }

  fs::path folder_;
};

TEST_P(Signals, EndSimulatedSessions) {
  expectPromptEnd({"limen-study", "simulate", "quick", "--observers", "100000", "--store", "s.sqlite"},
                  grows("s.sqlite"));
}

TEST_P(Signals, EndSimulatedSessionsInSeveralThreads) {
  expectPromptEnd(
      {"limen-study", "simulate", "quick", "--observers", "100000", "--jobs", "3", "--store", "s.sqlite"},
      grows("s.sqlite"));
}

TEST_P(Signals, EndAWorkedExample) {
  expectPromptEnd({"limen-study", "example", "schwarz_2009", "-o", "out"}, [this] {
    std::error_code none;
    for (const auto& entry : fs::recursive_directory_iterator(folder_, none))
      if (entry.path().extension() == ".sqlite") return true;
    return false;
  });
}

TEST_P(Signals, EndAPowerAnalysis) {
  const auto begin = std::chrono::steady_clock::now();
  expectPromptEnd({"limen-study", "power", "quick", "--simulations", "1000000"},
                  [begin] { return std::chrono::steady_clock::now() - begin > std::chrono::seconds(1); });
}

TEST_P(Signals, EndASlowPicture) {
  const auto begin = std::chrono::steady_clock::now();
  expectPromptEnd({"limen-view", "--screenshot", "out.png", "--size", "1024x1024", "--technique",
                   "soft_shadows/sampled_light", "--set", "technique.samples=4096"},
                  [begin] { return std::chrono::steady_clock::now() - begin > std::chrono::seconds(3); });
}

INSTANTIATE_TEST_SUITE_P(OfUsers, Signals, testing::Values(SIGINT, SIGTERM));

}  // namespace
}  // namespace limen
