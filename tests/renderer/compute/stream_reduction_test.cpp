// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/compute/stream_reduction.h"

#include <algorithm>
#include <random>
#include <set>
#include <string>

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

// Around 2^22 items: none, all, every other, and some; by what runs here and as devices with subgroups have
// it.
TEST_F(StreamReductions, KeepTheItemsOfLongStreams) {
  constexpr uint32_t kLong = 1U << 22;
  const ReductionSettings emulated{
      .form = ReductionForm::LookBack, .group = 32, .rows = 8, .emulateSubgroups = true};
  for (const ReductionSettings& settings : {ReductionSettings{}, emulated}) {
    const StreamReduction reduction(context(), kLong + 1, settings);
    for (const uint32_t count : {kLong - 1, kLong + 1})
      for (const uint32_t every : {0U, 1U, 2U, 5U}) {
        std::vector<bool> valid(count);
        for (uint32_t i = 0; i < count; ++i) valid[i] = every > 0 && i % every == 0;
        const Items in = itemsOf(valid, settings);
        // Compared as a whole: a message would be long.
        ASSERT_TRUE(reduced(reduction, settings, in) == sequentially(in, settings))
            << describe(settings) << ", " << count << " items, every " << every;
      }
  }
}

// Roger 2008, L1788 to L1815: blocks of 16, X invalid. Blocks of 8 and 32 must give the same.
TEST_F(StreamReductions, ReduceTheWorkedExampleOfTheThesis) {
  const std::string text = "43X192XX7X6X58X5431X2X6XX7X98XX5X87XX235XXX6XX1X1XXX45X7X6X8329X";
  const std::string expected = "43192765854312679858723561145768329";
  for (const ReductionSettings& settings : settingsOfAllForms()) {
    if (settings.lanes != 1 || settings.flagged || settings.form == ReductionForm::Append) continue;
    for (const int blockSize : {8, 16, 32}) {
      ReductionSettings with = settings;
      with.blockSize = blockSize;
      Items in;
      for (const char c : text) in.words.push_back(c == 'X' ? kInvalidItem : static_cast<uint32_t>(c - '0'));
      in.count = static_cast<uint32_t>(text.size());
      std::string found;
      for (const uint32_t word : reduced(StreamReduction(context(), 64, with), with, in))
        found += static_cast<char>('0' + word);
      EXPECT_EQ(found, expected) << describe(with);
    }
  }
}

// Blocks of 8 in rows of 16 texels, with every number of valid items from 0 to 8: lines start and end at each
// column, at the ends of rows too, some have no length, and some wrap by 1 to 7 texels.
TEST_F(StreamReductions, DrawLinesThatWrapAtAnyColumn) {
  for (const BlockJoin join : {BlockJoin::LinesTwice, BlockJoin::LinesSplit}) {
    const ReductionSettings settings{
        .form = ReductionForm::Hierarchical, .blockSize = 8, .join = join, .rowWidth = 16};
    std::set<std::pair<uint32_t, uint32_t>> seen;  // column, length
    for (uint32_t seed = 0; seed < 8; ++seed) {
      std::mt19937 random(seed);
      std::vector<bool> valid;
      uint32_t column = 0;
      for (int block = 0; block < 300; ++block) {
        const uint32_t length = random() % 9;
        seen.insert({column, length});
        column = (column + length) % 16;
        std::vector<bool> items(8, false);
        std::fill(items.begin(), items.begin() + length, true);
        std::shuffle(items.begin(), items.end(), random);
        valid.insert(valid.end(), items.begin(), items.end());
      }
      const Items in = itemsOf(valid, settings);
      ASSERT_EQ(reduced(StreamReduction(context(), in.count, settings), settings, in),
                sequentially(in, settings))
          << describe(settings);
    }
    EXPECT_EQ(seen.size(), 16U * 9U) << "some column and length did not occur";
  }
}

// Of 64 items 26 are invalid on average (60 % valid). A search by figure 4.7 takes few steps; the fixed one
// always 6. Each valid item's search fetches the two sums that bound it, and an absent one the first of these
// alone.
TEST_F(StreamReductions, CountWhatTheImprovedSearchSaves) {
  ReductionSettings settings{.form = ReductionForm::Hierarchical, .blockSize = 64, .countFetches = true};
  const Items in = randomItems(64 * 500, 0.6, settings);
  const auto valid = static_cast<uint32_t>(sequentially(in, settings).size());
  const auto fetchesBy = [&](ItemSearch search) {
    settings.search = search;
    const StreamReduction reduction(context(), in.count, settings);
    EXPECT_EQ(reduced(reduction, settings, in), sequentially(in, settings));
    return reduction.fetches();
  };
  EXPECT_EQ(fetchesBy(ItemSearch::Fixed), in.count + valid * 7);
  const uint32_t improved = fetchesBy(ItemSearch::Improved);
  // At least a guess and the proof that it is valid.
  EXPECT_GE(improved, in.count + valid * 3);
  EXPECT_LT(improved, in.count + valid * 7);
}

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
