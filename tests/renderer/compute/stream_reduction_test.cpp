// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/compute/stream_reduction.h"

#include <algorithm>
#include <random>

#include "tests/renderer/compute/reduction_fixture.h"

namespace limen::compute {
namespace {

class StreamReductions : public ReductionTest {};

TEST_F(StreamReductions, KeepTheValidItemsInOrderForAnyCount) {
  for (const ReductionSettings& settings : settingsOfAllForms()) {
    const StreamReduction reduction(context(), 300000, settings);
    for (const uint32_t count : counts())
      for (const double share : {0.0, 0.3, 1.0}) {
        const Items in = randomItems(count, share, settings);
        ASSERT_EQ(reduced(reduction, settings, in), sequentially(in, settings))
            << describe(settings) << ", " << count << " items, " << share << " of them valid";
      }
  }
}

// The second word of a ReducedCount, as an earlier reduction leaves it.
TEST_F(StreamReductions, TakeTheNumberOfItemsFromTheGpu) {
  for (const ReductionSettings& settings : settingsOfAllForms()) {
    const StreamReduction reduction(context(), 20000, settings);
    for (const uint32_t count : {0U, 1U, 4095U, 4096U, 9999U}) {
      const Items in = randomItems(count, 0.5, settings);
      const gl::Buffer countIn(std::vector<uint32_t>{1, count});
      Result result = run(reduction, settings, in, 20000, &countIn, 20000);
      const std::vector<uint32_t> expected = sequentially(in, settings);
      const size_t words = size_t{result.count.written} * static_cast<size_t>(settings.lanes);
      ASSERT_EQ(words, expected.size()) << describe(settings) << ", " << count << " items";
      result.words.resize(words);
      ASSERT_EQ(reduction.ordered() ? result.words : sorted(result.words, settings.lanes), expected)
          << describe(settings) << ", " << count << " items";
    }
    // More than there can be.
    const Items in = randomItems(20000, 0.5, settings);
    const gl::Buffer countIn(std::vector<uint32_t>{1, 4000000000U});
    EXPECT_EQ(run(reduction, settings, in, 20000, &countIn, 20000).count.valid,
              sequentially(in, settings).size() / static_cast<size_t>(settings.lanes));
  }
}

TEST_F(StreamReductions, CountWhatDoesNotFitAndWriteNothingBeyond) {
  for (const ReductionSettings& settings : settingsOfAllForms()) {
    const StreamReduction reduction(context(), 20000, settings);
    const Items in = randomItems(20000, 0.5, settings);
    const std::vector<uint32_t> all = sequentially(in, settings);
    const auto lanes = static_cast<size_t>(settings.lanes);
    for (const uint32_t capacity : {0U, 1U, 700U, 5000U}) {
      const Result result = run(reduction, settings, in, capacity);
      EXPECT_EQ(result.count.valid, all.size() / lanes) << describe(settings);
      EXPECT_EQ(result.count.written, capacity);
      EXPECT_EQ(result.count.lost, all.size() / lanes - capacity);
      EXPECT_EQ(result.count.groupsX * result.count.groupsY * result.count.groupsZ, (capacity + 63) / 64);
      for (size_t i = 0; i < result.words.size(); ++i)
        if (i >= capacity * lanes) {
          ASSERT_EQ(result.words[i], kUntouched) << describe(settings) << ", word " << i;
        } else if (reduction.ordered()) {
          ASSERT_EQ(result.words[i], all[i]) << describe(settings) << ", word " << i;
        }
    }
  }
}

// Nothing of a run may be left for the next: state is cleared, however many items there were.
TEST_F(StreamReductions, DoNotDependOnEarlierRuns) {
  for (const ReductionSettings& settings : settingsOfAllForms()) {
    const StreamReduction reduction(context(), 100000, settings);
    for (const uint32_t count : {100000U, 5U, 30000U, 0U, 100000U}) {
      const Items in = randomItems(count, 0.6, settings);
      ASSERT_EQ(reduced(reduction, settings, in), sequentially(in, settings))
          << describe(settings) << ", " << count << " items";
    }
  }
}

TEST_F(StreamReductions, DoNotRelyOnProgressOnSoftwareRenderers) {
  const StreamReduction reduction(context(), 10);
  if (context().device().software) {
    EXPECT_EQ(reduction.form(), ReductionForm::ScanScatter);
  }
}

}  // namespace
}  // namespace limen::compute
