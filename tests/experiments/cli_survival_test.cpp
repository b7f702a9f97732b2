// SPDX-License-Identifier: BSD-3-Clause
#include <signal.h>
#include <sqlite3.h>

#include <random>
#include <set>
#include <thread>

#include "experiments/base/error.h"
#include "experiments/store/store.h"
#include "tests/experiments/cli_fixture.h"
#include "tests/experiments/fake_bench.h"

namespace limen::experiments {
namespace {

using testing::HasSubstr;

constexpr int kRuns = 60;

/// 60 runs of `sleepMs` each.
std::string sleepyDescriptor(int sleepMs) {
  std::string samples = "1";
  for (int i = 2; i <= kRuns / 2; ++i) samples += ", " + std::to_string(i);
  return "title: a\nquestion: b\nscenes: [{name: grid, light_size: [1, 2]}]\ntiming: {batch: 4}\n"
         "techniques: [{name: soft/bitmask, samples: [" +
         samples + "], sleep_ms: " + std::to_string(sleepMs) + "}]\n";
}

std::string integrityOf(const std::string& file) {
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  std::string verdict;
  sqlite3_exec(
      database, "PRAGMA integrity_check",
      [](void* out, int, char** values, char**) {
        *static_cast<std::string*>(out) += values[0];
        return 0;
      },
      &verdict, nullptr);
  sqlite3_close(database);
  return verdict;
}

/// Empty also for a store that was killed while it was being made; what was announced must be there all the
/// same.
std::set<std::string> doneKeys(const std::string& file) {
  std::set<std::string> out;
  try {
    for (const store::Run& run : store::Store(file, store::Access::ReadOnly).allRuns())
      if (run.status == "done") out.insert(run.key);
  } catch (const Error&) {
  }
  return out;
}

TEST_F(SweepCli, KilledTwentyTimesLosesNoFinishedRunAndRepeatsNone) {
  write("d.yaml", sleepyDescriptor(4));
  std::mt19937 random(20240501);
  int interruptedInTheMiddle = 0;
  for (int kill = 0; kill < 20; ++kill) {
    std::filesystem::remove_all(folder_ / "results");
    const pid_t child = start({"d.yaml", "--json", "--no-report"});
    std::this_thread::sleep_for(std::chrono::milliseconds(std::uniform_int_distribution(5, 250)(random)));
    ::kill(child, SIGKILL);
    const CallResult killed = wait(child);
    // A run that the program has announced is committed. The last line may be cut.
    std::set<std::string> announced;
    std::istringstream stream(killed.out);
    for (std::string line; std::getline(stream, line) && !stream.eof();)
      if (const auto json = nlohmann::json::parse(line); json.contains("key"))
        announced.insert(json["key"].get<std::string>());
    std::set<std::string> done;
    if (exists("results/d.sqlite") && std::filesystem::file_size(folder_ / "results/d.sqlite") > 0) {
      EXPECT_EQ(integrityOf(path("results/d.sqlite")), "ok");
      done = doneKeys(path("results/d.sqlite"));
    }
    for (const std::string& key : announced) EXPECT_TRUE(done.count(key)) << "lost after kill " << kill;
    interruptedInTheMiddle += !done.empty() && done.size() < kRuns ? 1 : 0;

    const CallResult resumed = call({"d.yaml", "--json", "--no-report"});
    ASSERT_EQ(resumed.exitCode, 0) << resumed.err;
    const auto lines = jsonLines(resumed.out);
    EXPECT_EQ(lines.size(), kRuns - done.size() + 1) << "exactly the missing runs are measured";
    for (size_t i = 0; i + 1 < lines.size(); ++i)
      EXPECT_FALSE(done.count(lines[i]["key"].get<std::string>()));
    EXPECT_EQ(lines.back()["skipped"], done.size());
    EXPECT_EQ(doneKeys(path("results/d.sqlite")).size(), static_cast<size_t>(kRuns));
    EXPECT_EQ(integrityOf(path("results/d.sqlite")), "ok");
  }
  EXPECT_GT(interruptedInTheMiddle, 3) << "the kills came too early or too late to test anything";
}

TEST_F(SweepCli, TwoSweepsShareOneStoreAndItsWork) {
  write("d.yaml", sleepyDescriptor(10));
  const pid_t first = start({"d.yaml", "--json", "--no-report"}, "first");
  const pid_t second = start({"d.yaml", "--json", "--no-report"}, "second");
  const CallResult one = wait(first, "first"), other = wait(second, "second");
  EXPECT_EQ(one.exitCode, 0) << one.err;
  EXPECT_EQ(other.exitCode, 0) << other.err;
  std::multiset<std::string> keys;
  int done = 0;
  for (const CallResult& result : {one, other}) {
    const auto lines = jsonLines(result.out);
    for (size_t i = 0; i + 1 < lines.size(); ++i) keys.insert(lines[i]["key"].get<std::string>());
    EXPECT_EQ(lines.back()["planned"], kRuns);
    EXPECT_EQ(lines.back()["done"].get<int>() + lines.back()["skipped"].get<int>(), kRuns);
    EXPECT_GT(lines.back()["done"].get<int>(), 0) << "one sweep did all the work";
    done += lines.back()["done"].get<int>();
  }
  EXPECT_EQ(done, kRuns);
  EXPECT_EQ(std::set<std::string>(keys.begin(), keys.end()).size(), keys.size())
      << "a run was measured twice";
  EXPECT_EQ(doneKeys(path("results/d.sqlite")).size(), static_cast<size_t>(kRuns));
}

TEST_F(SweepCli, TakesOverTheRunsOfASweepThatDiesWhileItIsWaitedFor) {
  write("d.yaml",
        "title: a\nquestion: b\nscenes: [{name: grid}]\n"
        "techniques: [{name: soft/bitmask, samples: [1, 2], sleep_ms: 3000}]\n");
  const pid_t first = start({"d.yaml", "--no-report"}, "first");
  while (!exists("results/d.sqlite")) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const pid_t second = start({"d.yaml", "--no-report"}, "second");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  ::kill(first, SIGKILL);
  wait(first, "first");
  const CallResult result = wait(second, "second");
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_THAT(result.out, HasSubstr("waiting for 2 runs held by another sweep"));
  EXPECT_THAT(result.out, HasSubstr("2 planned, 2 measured"));
}

TEST_F(SweepCli, InterruptEndsInOrderAndSaysHowToGoOn) {
  for (const int signal : {SIGINT, SIGTERM}) {
    std::filesystem::remove_all(folder_ / "results");
    write("d.yaml", sleepyDescriptor(20));
    const pid_t child = start({"d.yaml", "--no-report"});
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    ::kill(child, signal);
    const CallResult result = wait(child);
    EXPECT_EQ(result.exitCode, 128 + signal);
    EXPECT_THAT(result.out, HasSubstr("resumes where it stopped"));
    for (const store::Run& run : store::Store(path("results/d.sqlite"), store::Access::ReadOnly).allRuns())
      EXPECT_EQ(run.status, "done") << "a claim was left behind";
    const size_t done = doneKeys(path("results/d.sqlite")).size();
    EXPECT_GT(done, 0U);
    EXPECT_LT(done, static_cast<size_t>(kRuns));
    const CallResult resumed = call({"d.yaml", "--no-report", "--json"});
    EXPECT_EQ(jsonLines(resumed.out).back()["done"], kRuns - done);
  }
}

// A call into a driver or a library asks nobody.
TEST_F(SweepCli, InterruptDoesNotWaitForALongRun) {
  for (const int signal : {SIGINT, SIGTERM}) {
    std::filesystem::remove_all(folder_ / "results");
    write("d.yaml",
          "title: a\nquestion: b\nscenes: [{name: grid}]\n"
          "techniques: [{name: soft/bitmask, samples: [1], sleep_ms: 10000}]\n");
    const pid_t child = start({"d.yaml", "--no-report"});
    std::this_thread::sleep_for(std::chrono::milliseconds(1000));
    ::kill(child, signal);
    const auto sent = std::chrono::steady_clock::now();
    EXPECT_EQ(wait(child).exitCode, 128 + signal);
    EXPECT_LT(std::chrono::steady_clock::now() - sent, std::chrono::milliseconds(1500));
    EXPECT_TRUE(store::Store(path("results/d.sqlite"), store::Access::ReadOnly).allRuns().empty())
        << "a claim was left behind";
  }
}

TEST_F(SweepCli, ARunThatKillsItsProcessTwiceFailsAndTheSweepGoesOn) {
  write("box.obj", "v 0 0 0\n");
  write("d.yaml",
        "title: a\nquestion: b\nscenes: [{name: mesh, file: box.obj}]\ntiming: {batch: 4}\n"
        "techniques: [{name: soft/bitmask, samples: [1, 2, 3]}, {name: soft/pcss, die: [false, true]}]\n");
  const auto run = [&](const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"d.yaml", "--no-report"};
    words.insert(words.end(), more.begin(), more.end());
    return wait(start(words));
  };
  run();
  run();
  // A batch died with it at first; it alone is blamed.
  const CallResult third = run();
  EXPECT_EQ(third.exitCode, 1) << third.err;
  EXPECT_EQ(doneKeys(path("results/d.sqlite")).size(), 4U) << third.out;
  EXPECT_THAT(third.out, HasSubstr("died twice"));
  EXPECT_THAT(third.out, HasSubstr("box.obj"));
  const CallResult fourth = run();
  EXPECT_EQ(fourth.exitCode, 1) << "it is not tried again";
  EXPECT_THAT(fourth.out, HasSubstr("--retry-died"));
  std::vector<std::string> states;
  for (const store::Run& row : store::Store(path("results/d.sqlite"), store::Access::ReadOnly).allRuns()) {
    states.push_back(row.status);
    if (row.status == "failed") {
      EXPECT_THAT(row.error, HasSubstr("soft/pcss in the scene 'mesh' of 'box.obj'"));
    }
  }
  EXPECT_EQ(std::count(states.begin(), states.end(), "failed"), 1);
  EXPECT_EQ(states.size(), 5U);
  EXPECT_NE(run({"--retry-died"}).exitCode, 1) << "asked to, it tries, and dies";
}

}  // namespace
}  // namespace limen::experiments
