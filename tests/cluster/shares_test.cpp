// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/shares.h"

#include <gmock/gmock.h>

#include <numeric>
#include <set>

namespace limen::experiments {
namespace {

using testing::ElementsAre;

/// Groups of these sizes, whose runs are interleaved four at a time.
Plan planOf(const std::vector<size_t>& groups) {
  Plan plan;
  for (const size_t size : groups) {
    plan.groups.emplace_back(plan.runs.size(), plan.runs.size() + size);
    plan.runs.resize(plan.runs.size() + size);
  }
  for (PlannedRun& run : plan.runs) run.timing.batch = 4;
  return plan;
}

TEST(Shares, BatchesAreThoseOfAnUnsharedSweep) {
  const Plan plan = planOf({6, 3});
  std::vector<size_t> all(9);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_THAT(batchesOf(plan, all),
              ElementsAre(ElementsAre(0, 1, 2, 3), ElementsAre(4, 5), ElementsAre(6, 7, 8)));
}

TEST(Shares, WhatIsDoneIsLeftOutAndTheRestMovesUp) {
  EXPECT_THAT(batchesOf(planOf({6, 3}), {1, 2, 4, 5, 8}),
              ElementsAre(ElementsAre(1, 2, 4, 5), ElementsAre(8)));
  EXPECT_TRUE(batchesOf(planOf({6, 3}), {}).empty());
}

TEST(Shares, EveryBatchIsDealtOnceAndNoTaskGetsTwoMoreThanAnother) {
  for (size_t batches = 0; batches < 40; ++batches)
    for (size_t count = 1; count < 12; ++count) {
      std::set<size_t> seen;
      size_t least = batches, most = 0, total = 0;
      for (const std::vector<size_t>& mine : deal(batches, count)) {
        seen.insert(mine.begin(), mine.end());
        total += mine.size();
        least = std::min(least, mine.size());
        most = std::max(most, mine.size());
      }
      EXPECT_EQ(seen.size(), batches);
      EXPECT_EQ(total, batches);
      EXPECT_LE(most - std::min(least, most), 1U);
    }
}

TEST(Shares, CostsThatGrowAlongThePlanAreEvenlyShared) {
  // Batch i costs i. Dealt in turns always from the first task on, the last of 8 tasks would get 7 * 20 more
  // than the first.
  std::vector<double> cost;
  for (const std::vector<size_t>& mine : deal(160, 8))
    cost.push_back(std::accumulate(mine.begin(), mine.end(), 0.0));
  EXPECT_EQ(*std::max_element(cost.begin(), cost.end()), *std::min_element(cost.begin(), cost.end()));
}

}  // namespace
}  // namespace limen::experiments
