// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class StreamTechniques : public TechniqueTest {
 protected:
  static std::vector<float> productOf(const scene::Scene& scene, const std::string& technique,
                                      const Given& given = {}) {
    return render(scene, technique, given, {8, 8}).product.data;
  }
  /// The scene's items that `keep` takes, then what ends a stream.
  template <class Keep>
  static void appendItems(const scene::ItemStream& stream, std::vector<float>& to, Keep keep) {
    for (size_t i = 0; i < stream.items.size(); ++i)
      if (stream.items[i] != scene::ItemStream::kInvalid && keep(i)) to.push_back(float(i));
  }
};

TEST_F(StreamTechniques, GiveTheValidItemsInOrderAndThenTheEnd) {
  // 3 x 1024 items and more: the product has four rows.
  const scene::Scene scene = makeScene("stream", {{"elements", int64_t{3333}}});
  std::vector<float> expected;
  appendItems(*scene.items, expected, [](size_t) { return true; });
  expected.resize(4096, kStreamEnd);
  for (const char* name : {"scatter", "block_sequential", "append", "horn", "blelloch", "hierarchical",
                           "geometry_shader", "sequential"}) {
    std::vector<float> found = productOf(scene, std::string("stream_reduction/") + name);
    if (std::string(name) == "append") {
      EXPECT_TRUE(std::is_permutation(found.begin(), found.end(), expected.begin(), expected.end()));
      continue;
    }
    EXPECT_EQ(found, expected) << name;
  }
}

TEST_F(StreamTechniques, CarryPairsAndObeyFlags) {
  const scene::Scene scene = makeScene("stream", {{"elements", int64_t{3333}}});
  const std::vector<float> expected = productOf(scene, "stream_reduction/sequential");
  for (const char* name :
       {"scatter", "block_sequential", "horn", "blelloch", "hierarchical", "geometry_shader"})
    EXPECT_EQ(productOf(scene, std::string("stream_reduction/") + name,
                        {{"payload", int64_t{2}}, {"flagged", true}}),
              expected)
        << name;
}

TEST_F(StreamTechniques, DistributeToBucketsInOrder) {
  const scene::Scene scene = makeScene("stream", {{"elements", int64_t{3333}}, {"buckets", int64_t{5}}});
  std::vector<float> expected;
  for (uint32_t bucket = 0; bucket < 5; ++bucket)
    appendItems(*scene.items, expected, [&](size_t i) { return scene.items->keys[i] == bucket; });
  expected.resize(4096, kStreamEnd);
  EXPECT_EQ(productOf(scene, "stream_reduction/bucket_sort"), expected);
  EXPECT_EQ(productOf(scene, "stream_reduction/sequential_distribution"), expected);
}

// Running sums of the items that are valid, by hand; a copy shows what it was given. 4,096 items and more are
// several tiles of a scan, 3,072 a whole number of rows.
TEST_F(StreamTechniques, CountTheValidItemsBeforeEach) {
  for (const int64_t elements : {0, 1, 3072, 9999}) {
    const scene::Scene scene = makeScene("stream", {{"elements", elements}});
    std::vector<float> expected;
    float valid = 0.0F;
    for (const uint32_t item : scene.items->items) {
      expected.push_back(valid);
      if (item != scene::ItemStream::kInvalid) valid += 1.0F;
    }
    expected.resize(size_t(elements / 1024 + 1) * 1024, kStreamEnd);
    for (const char* scan : {"look_back", "reduce_then_scan"})
      EXPECT_EQ(productOf(scene, "stream_reduction/prefix_sum", {{"scan", std::string(scan)}}), expected)
          << scan << " " << elements;
    for (const char* by : {"compute", "driver"})
      EXPECT_EQ(productOf(scene, "stream_reduction/copy", {{"by", std::string(by)}}), expected)
          << by << " " << elements;
    EXPECT_EQ(productOf(scene, "stream_reduction/sequential_sums"), expected) << elements;
  }
}

TEST_F(StreamTechniques, RefuseRowsShorterThanABlock) {
  const std::optional<Error> refused = refusal(
      "stream_reduction/hierarchical",
      {{"block_size", int64_t{512}}, {"row_width", int64_t{64}}, {"join", std::string("lines_split")}});
  ASSERT_TRUE(refused);
  EXPECT_FALSE(
      refusal("stream_reduction/hierarchical", {{"block_size", int64_t{512}}, {"row_width", int64_t{64}}}));
}

}  // namespace
}  // namespace limen::techniques
