// SPDX-License-Identifier: BSD-3-Clause
#include <signal.h>

#include <chrono>
#include <regex>
#include <thread>

#include "experiments/store/store.h"
#include "tests/experiments/cli_fixture.h"

namespace limen::experiments {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A machine with a software renderer (0) and three GPUs of one kind (1 to 3).
class SweepOnGpus : public SweepCli {
 protected:
  void SetUp() override {
    SweepCli::SetUp();
    setenv("FAKE_GPUS", "3", 1);
    for (const char* name : {"FAKE_GIVEN", "FAKE_OPEN_S", "FAKE_BROKEN"}) unsetenv(name);
  }
  void TearDown() override {
    for (const char* name : {"FAKE_OPEN_S", "FAKE_BROKEN"}) unsetenv(name);
    SweepCli::TearDown();
  }

  /// Processes that a process started to measure.
  static std::vector<pid_t> measuringFor(pid_t parent) {
    std::vector<pid_t> out;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      const std::string name = entry.path().filename().string();
      std::ifstream in(entry.path() / "cmdline", std::ios::binary);
      const std::string words{std::istreambuf_iterator<char>(in), {}};
      if (words.find("--parent=" + std::to_string(parent) + '\0') != std::string::npos)
        out.push_back(std::stoi(name));
    }
    return out;
  }

  static std::string descriptor(int sleepMs, const std::string& more = "") {
    return "title: a\nquestion: b\nscenes: [{name: grid, light_size: [1, 2]}]\ntiming: {batch: 2}\n"
           "techniques:\n  - {name: soft/bitmask, samples: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12], "
           "sleep_ms: " +
           std::to_string(sleepMs) + "}\n" + more +
           "reference: {name: soft/sampled, samples: 256}\nmetrics: [rmse]\nexpect: [{metric: rmse, below: "
           "2}]\n";
  }

  /// Waits until a task says that it has finished a run; false if that takes more than 20 s.
  bool someRunIsDone() const {
    for (int i = 0; i < 400; ++i) {
      for (int task = 1; task <= 3; ++task) {
        const std::string name = "results/d_tasks/1/task_" + std::to_string(task) + ".progress";
        if (std::regex_search(read(name), std::regex("\"done\": ?[1-9]"))) return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }

  std::vector<store::Run> runs(const std::string& name) const {
    return store::Store(path(name), store::Access::ReadOnly).allRuns();
  }
};

TEST_F(SweepOnGpus, TheStoreIsThatOfOneGpuAndTheSweepEndsAsUsual) {
  write("d.yaml", descriptor(0));
  ASSERT_EQ(call({"d.yaml", "--device", "1", "--store", "one.sqlite"}).exitCode, 0);
  const CallResult result = call({"d.yaml", "--gpus", "all", "--store", "all.sqlite"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("24 of 24 runs left, on 3 GPUs"), HasSubstr("24 measured"),
                                HasSubstr("held: rmse")));
  std::map<std::string, nlohmann::json> expected, found;
  for (const store::Run& run : runs("one.sqlite")) expected[run.key] = run.sceneFacts;
  for (const store::Run& run : runs("all.sqlite")) {
    found[run.key] = run.sceneFacts;
    EXPECT_EQ(run.device, "fake GPU");
    EXPECT_EQ(run.status, "done");
  }
  EXPECT_EQ(found, expected);
  EXPECT_THAT(call({"d.yaml", "--gpus", "all", "--store", "all.sqlite"}).out,
              AllOf(HasSubstr("0 measured, 24 done before")));
}

TEST_F(SweepOnGpus, InAJobOfSlurmAllAreThoseThatItWasGiven) {
  write("d.yaml", descriptor(0));
  setenv("FAKE_GIVEN", "2", 1);
  EXPECT_THAT(call({"--list", "devices"}).out,
              AllOf(HasSubstr("1  fake GPU, not given to this job"), HasSubstr("2  fake GPU\n")));
  const CallResult one = call({"d.yaml", "--gpus", "all", "--no-report"});
  EXPECT_EQ(one.exitCode, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("on 1 GPU;"));
  setenv("FAKE_GIVEN", "?", 1);
  const CallResult unknown = call({"d.yaml", "--gpus", "all", "--no-report"});
  EXPECT_EQ(unknown.exitCode, 2);
  EXPECT_THAT(unknown.err, AllOf(HasSubstr("cannot be told"), HasSubstr("--gpus 0,2")));
  EXPECT_EQ(call({"d.yaml", "--gpus", "1,3", "--no-report"}).exitCode, 0) << "whoever names them knows";
}

TEST_F(SweepOnGpus, GpusWorkAtTheSameTime) {
  write("d.yaml", descriptor(100));
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(call({"d.yaml", "--gpus", "1,3", "--no-report"}).exitCode, 0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  // One after another the runs sleep 2.4 s, side by side 1.2 s.
  EXPECT_LT(seconds, 2.2);
}

TEST_F(SweepOnGpus, DevicesAreOpenedOnceAndSideBySide) {
  setenv("FAKE_OPEN_S", "1", 1);
  write("d.yaml", descriptor(0));
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(call({"d.yaml", "--gpus", "all", "--no-report"}).exitCode, 0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  // Twice, or one after another, would take 2 or 3 s.
  EXPECT_LT(seconds, 1.9);
}

TEST_F(SweepOnGpus, ADeviceThatCannotBeOpenedIsLeftOutOrRefused) {
  setenv("FAKE_BROKEN", "2", 1);
  write("d.yaml", descriptor(0));
  const CallResult named = call({"d.yaml", "--gpus", "1,2", "--no-report"});
  EXPECT_EQ(named.exitCode, 2);
  EXPECT_THAT(named.err, HasSubstr("there is no device 2 to measure on: no OpenGL 4.5"));
  EXPECT_FALSE(exists("results"));
  const CallResult all = call({"d.yaml", "--gpus", "all", "--no-report"});
  EXPECT_EQ(all.exitCode, 0) << all.err;
  EXPECT_THAT(all.out, HasSubstr("on 2 GPUs"));
}

TEST_F(SweepOnGpus, ProcessesThatStandByEndWithTheSweep) {
  setenv("FAKE_OPEN_S", "20", 1);
  write("d.yaml", descriptor(0));
  for (const int signal : {SIGKILL, SIGTERM}) {
    const pid_t sweep = start({"d.yaml", "--gpus", "all", "--no-report"});
    for (int i = 0; i < 200 && measuringFor(sweep).size() < 3; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ASSERT_EQ(measuringFor(sweep).size(), 3U);
    kill(sweep, signal);
    wait(sweep);
    for (int i = 0; i < 200 && !measuringFor(sweep).empty(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_TRUE(measuringFor(sweep).empty()) << signal;
  }
  EXPECT_FALSE(exists("results"));
}

TEST_F(SweepOnGpus, AProcessThatIsKilledIsStartedAgain) {
  write("d.yaml", descriptor(250));
  const pid_t sweep = start({"d.yaml", "--gpus", "all", "--no-report"});
  ASSERT_TRUE(someRunIsDone());
  const std::vector<pid_t> before = measuringFor(sweep);
  ASSERT_EQ(before.size(), 3U);
  kill(before[0], SIGKILL);
  const CallResult result = wait(sweep);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("24 measured"));
}

TEST_F(SweepOnGpus, ARunThatKillsItsProcessFailsAndTheOthersAreMeasured) {
  write("d.yaml", descriptor(0, "  - {name: soft/pcss, die: true}\n"));
  const CallResult result = call({"d.yaml", "--gpus", "1,2", "--no-report"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.out, AllOf(HasSubstr("24 measured"), HasSubstr("2 failed"), HasSubstr("died twice")));
}

TEST_F(SweepOnGpus, KilledWithAllItsProcessesItGoesOnWhereItWas) {
  write("d.yaml", descriptor(60));
  const pid_t child = start({"d.yaml", "--gpus", "all", "--no-report"});
  ASSERT_TRUE(someRunIsDone());
  kill(child, SIGKILL);
  wait(child);
  // Its processes end by themselves.
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  const CallResult again = call({"d.yaml", "--gpus", "all", "--no-report"});
  EXPECT_EQ(again.exitCode, 0) << again.err;
  EXPECT_EQ(runs("results/d.sqlite").size(), 24U);
  std::smatch found;
  const std::string text = again.out;
  ASSERT_TRUE(std::regex_search(text, found, std::regex("(\\d+) measured, (\\d+) done before"))) << text;
  EXPECT_GT(std::stoi(found[2]), 0) << "what was finished before is kept";
}

TEST_F(SweepOnGpus, InterruptedItKeepsWhatIsFinished) {
  write("d.yaml", descriptor(250));
  const pid_t child = start({"d.yaml", "--gpus", "1,2", "--no-report"});
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  kill(child, SIGINT);
  const CallResult result = wait(child);
  EXPECT_EQ(result.exitCode, 130) << result.err;
  EXPECT_THAT(result.out, HasSubstr("interrupted"));
  EXPECT_GT(runs("results/d.sqlite").size(), 0U);
  EXPECT_LT(runs("results/d.sqlite").size(), 24U);
}

TEST_F(SweepOnGpus, WhatIsNoGpuIsRefused) {
  write("d.yaml", descriptor(0));
  for (const char* which : {"4", "x", "1,1", "", "-1", "1,"})
    EXPECT_EQ(call({"d.yaml", "--gpus", which}).exitCode, 2) << which;
  EXPECT_THAT(call({"d.yaml", "--gpus", "4"}).err, HasSubstr("--list devices"));
  EXPECT_THAT(call({"d.yaml", "--gpus", "all", "--shard", "1/2"}).err, HasSubstr("--gpus"));
  EXPECT_FALSE(exists("results"));
  unsetenv("FAKE_GPUS");
  EXPECT_THAT(call({"d.yaml", "--gpus", "all"}).err, HasSubstr("there is no GPU"));
}

TEST_F(SweepOnGpus, DevicesAreListedByTheirIndices) {
  const CallResult result = call({"--list", "devices"});
  EXPECT_EQ(result.out, "0  fake renderer, software renderer\n1  fake GPU\n2  fake GPU\n3  fake GPU\n");
}

}  // namespace
}  // namespace limen::experiments
