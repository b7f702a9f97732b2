// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/compute/bucket_sort.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "tests/renderer/gl/gl_fixture.h"

namespace limen::compute {
namespace {

class BucketSorts : public gl::GlTest {};

TEST_F(BucketSorts, EqualAStableSortForAnyNumberOfBuckets) {
  for (const int buckets : {1, 2, 3, 4, 8, 9, 15, 16})
    for (const uint32_t count : {0U, 1U, 255U, 256U, 257U, 1023U, 1024U, 1025U, 50001U}) {
      std::mt19937 random(count + static_cast<uint32_t>(buckets));
      std::vector<uint32_t> items(count), keys(count), order;
      for (uint32_t i = 0; i < count; ++i) {
        items[i] = random() % 10 < 6 ? static_cast<uint32_t>(random() % 1000) : kInvalidItem;
        // Some keys are no bucket.
        keys[i] = static_cast<uint32_t>(random() % static_cast<uint32_t>(buckets + 1));
        if (items[i] != kInvalidItem && keys[i] < static_cast<uint32_t>(buckets)) order.push_back(i);
      }
      std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return keys[a] < keys[b]; });
      std::vector<uint32_t> expected, starts(static_cast<size_t>(buckets) + 1);
      for (const uint32_t i : order) expected.push_back(items[i]), ++starts[keys[i] + 1];
      std::partial_sum(starts.begin(), starts.end(), starts.begin());

      const BucketSort sort(context(), count, buckets);
      const gl::Buffer itemsIn(items), keysIn(keys), out(std::vector<uint32_t>(count + 100, 55555)),
          startsOut(std::vector<uint32_t>(static_cast<size_t>(buckets) + 1));
      sort.run(itemsIn, keysIn, count, out, startsOut);
      ASSERT_EQ(out.read<uint32_t>(0, static_cast<int64_t>(expected.size())), expected)
          << buckets << " buckets, " << count << " items";
      ASSERT_EQ(startsOut.read<uint32_t>(0, buckets + 1), starts)
          << buckets << " buckets, " << count << " items";
      // Nothing is written beyond.
      ASSERT_EQ(out.read<uint32_t>(static_cast<int64_t>(expected.size()) * 4, 1)[0], 55555U);
    }
}

}  // namespace
}  // namespace limen::compute
