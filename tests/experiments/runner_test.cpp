// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "experiments/base/error.h"
#include "tests/experiments/fake_bench.h"

namespace limen::experiments {
namespace {

class Quiet : public SweepObserver {
 public:
  void begin(size_t, size_t) override {}
  void measuring(const PlannedRun&, size_t) override {}
  void finished(const PlannedRun& run, const store::Run&) override { order.push_back(run.key); }
  void doneElsewhere(const PlannedRun&) override {}
  void waiting(size_t) override {}
  std::vector<std::string> order;
};

class RunnerTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "limen_runner_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    results_ = std::make_unique<store::Store>((folder_ / "r.sqlite").string(), store::Access::ReadWrite);
    usePlan(validDescriptor());
  }
  void TearDown() override {
    results_.reset();
    std::filesystem::remove_all(folder_);
  }
  void usePlan(const std::string& text) {
    descriptor_ = parseDescriptor(text, "d.yaml", fakeCatalogue(), {});
    plan_ = makePlan(descriptor_, fakeCatalogue());
  }
  SweepTally run(Executor& executor, const RunnerOptions& options = {}) {
    return runSweep(plan_, *results_, executor, nlohmann::json::object(), options, observer_);
  }

  std::filesystem::path folder_;
  std::unique_ptr<store::Store> results_;
  Descriptor descriptor_;
  Plan plan_;
  Quiet observer_;
};

TEST_F(RunnerTest, BatchesShareSceneAndSizeAndKeepTheirLimit) {
  std::string text = validDescriptor();
  text.replace(text.find("rounds: 2"), 9, "rounds: 2, batch: 3");
  usePlan(text);
  FakeExecutor executor;
  const SweepTally tally = run(executor);
  EXPECT_EQ(tally.done, 10U);
  // Two scenes of five runs each.
  EXPECT_THAT(executor.batchSizes, testing::ElementsAre(3, 2, 3, 2));
}

TEST_F(RunnerTest, EveryRunIsInTheStoreBeforeTheNextBegins) {
  FakeExecutor executor;
  size_t finished = 0;
  executor.before = [&](const PlannedRun&) {
    size_t done = 0;
    for (const store::Run& row : results_->allRuns()) done += row.status == "done" ? 1 : 0;
    EXPECT_EQ(done, finished++);
  };
  run(executor);
  EXPECT_EQ(finished, 10U);
}

TEST_F(RunnerTest, SkipsWhatIsDoneForThisDeviceOnly) {
  FakeExecutor executor, again, other("another device");
  run(executor);
  EXPECT_EQ(run(again).skipped, 10U);
  EXPECT_TRUE(again.executed.empty());
  EXPECT_EQ(run(other).done, 10U);
}

TEST_F(RunnerTest, AnExecutorThatGivesUpLeavesNoClaim) {
  FakeExecutor executor;
  size_t calls = 0;
  executor.before = [&](const PlannedRun&) {
    if (++calls == 4) throw Error("the device was lost");
  };
  EXPECT_THROW(run(executor), Error);
  for (const store::Run& row : results_->allRuns()) EXPECT_EQ(row.status, "done");
  EXPECT_EQ(results_->allRuns().size(), 3U);
  FakeExecutor next;
  const SweepTally tally = run(next);
  EXPECT_EQ(tally.skipped, 3U);
  EXPECT_EQ(tally.done, 7U);
}

TEST_F(RunnerTest, ShardsTogetherDoEveryRunOnce) {
  std::set<std::string> keys;
  size_t sum = 0;
  for (int index = 1; index <= 3; ++index) {
    FakeExecutor executor;
    RunnerOptions options;
    options.shardIndex = index;
    options.shardCount = 3;
    sum += run(executor, options).done;
    keys.insert(executor.executed.begin(), executor.executed.end());
  }
  EXPECT_EQ(sum, 10U);
  EXPECT_EQ(keys.size(), 10U);
}

TEST_F(RunnerTest, FailFastLeavesTheRestAndAFailedRunIsTriedAgain) {
  usePlan(
      "title: a\nquestion: b\nscenes: [{name: grid}]\ntiming: {batch: 1}\n"
      "techniques: [{name: soft/bitmask, samples: [1, 2], fail: [true, false]}]\n");
  FakeExecutor first, second;
  RunnerOptions options;
  options.failFast = true;
  const SweepTally stopped = run(first, options);
  EXPECT_EQ(stopped.failed, 1U);
  EXPECT_EQ(stopped.left, 3U);
  const SweepTally whole = run(second);
  EXPECT_EQ(whole.failed, 2U);
  EXPECT_EQ(whole.done, 2U);
  EXPECT_EQ(second.executed.size(), 4U);
}

}  // namespace
}  // namespace limen::experiments
