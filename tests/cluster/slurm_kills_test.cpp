// SPDX-License-Identifier: BSD-3-Clause
#include <random>

#include "experiments/base/hash.h"
#include "tests/cluster/slurm_fixture.h"

namespace limen::experiments {
namespace {

constexpr int kRuns = 40;

int fromEnvironment(const char* name, int otherwise) {
  const char* const text = std::getenv(name);
  return text ? std::atoi(text) : otherwise;
}

class SlurmKills : public SlurmTest {
 protected:
  void pause(int fromMs, int toMs) {
    std::this_thread::sleep_for(
        std::chrono::milliseconds(std::uniform_int_distribution(fromMs, toMs)(random_)));
  }

  void killOne(const std::string& words) {
    const std::vector<pid_t> all = processes(words);
    if (all.empty()) return;
    const pid_t one = all[std::uniform_int_distribution<size_t>(0, all.size() - 1)(random_)];
    // With what it keeps running, which otherwise is only told to stop.
    for (const pid_t child : processes("--parent=" + std::to_string(one))) kill(child, SIGKILL);
    kill(one, SIGKILL);
    ++kills_;
  }

  /// One disaster after some time; returns what is to be revived.
  void strike() {
    switch (std::uniform_int_distribution(0, 3)(random_)) {
      case 0:
        pause(300, 1500);
        return killOne("job measure " + folder_.string());
      case 1:
        pause(300, 1500);
        return killOne("job task " + folder_.string());
      case 2: {
        pause(300, 1500);
        const std::string node = "n" + std::to_string(std::uniform_int_distribution(1, 3)(random_));
        slurm({"crash", cluster_, node});
        ++kills_;
        pause(100, 5000);
        slurm({"revive", cluster_, node});
        return;
      }
      default: {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (processes("job merge " + folder_.string()).empty() && std::chrono::steady_clock::now() < end &&
               !allOver())
          std::this_thread::sleep_for(std::chrono::milliseconds(2));
        pause(0, 60);
        killOne("job merge " + folder_.string());
      }
    }
  }

  std::mt19937 random_;
  int kills_ = 0;
};

/// LIMEN_KILL_ROUNDS=100 is the long form, LIMEN_KILL_SEED=N another one.
TEST_F(SlurmKills, RandomKillsOfTasksNodesAndMergesLoseNothingAndMeasureNothingTwice) {
  const int rounds = fromEnvironment("LIMEN_KILL_ROUNDS", 2), seed = fromEnvironment("LIMEN_KILL_SEED", 1);
  for (int round = 0; round < rounds; ++round) {
    SCOPED_TRACE("round " + std::to_string(seed + round));
    random_.seed(static_cast<unsigned>(seed + round));
    std::filesystem::remove_all(folder_ / "results");
    // Another sweep each time.
    write("d.yaml", "# " + std::to_string(round) + "\n" + tasksDescriptor(kRuns, 150));
    ASSERT_EQ(call({"submit", "d.yaml", "--array", "5", "--no-report"}).exitCode, 0);
    const int disasters = std::uniform_int_distribution(1, 3)(random_);
    for (int i = 0; i < disasters; ++i) strike();
    std::map<std::string, std::string> found;
    // What Slurm gives up (a job that was killed as a whole) a person submits again.
    for (int submissions = 0; submissions < 5; ++submissions) {
      ASSERT_TRUE(eventually(allOver, 120)) << runAndRead({"squeue", "-t", "all"}).out;
      found = hashes(path("results/d.sqlite"));
      if (found.size() == kRuns) break;
      ASSERT_EQ(call({"submit", "d.yaml", "--array", "5", "--no-report"}).exitCode, 0) << read("call.err");
    }
    std::map<std::string, std::string> expected;
    for (const nlohmann::json& line : jsonLines(call({"d.yaml", "--dry-run", "--json"}).out))
      if (line.contains("key"))
        expected[line["key"]] = sha256("product of " + line["key"].get<std::string>());
    EXPECT_EQ(found, expected);
    size_t measured = 0;
    for (const Submission& submission : readSubmissions(path("results/d.sqlite")))
      for (int task = 1; task <= submission.tasks; ++task)
        if (const std::string store = taskStore(submission, task); std::filesystem::exists(store)) try {
            measured += hashes(store).size();
          } catch (const Error&) {
            // Its process was killed while it made the file.
          }
    EXPECT_EQ(measured, static_cast<size_t>(kRuns)) << "runs that were finished are not measured again";
    if (HasFailure()) return;
  }
  std::cout << rounds << " rounds, " << kills_ << " kills\n";
}

}  // namespace
}  // namespace limen::experiments
