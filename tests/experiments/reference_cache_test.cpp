// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/reference_cache.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace limen::experiments {
namespace {

class ReferenceCacheTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "limen_cache_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// The reference's first value, of a cache that has nothing in memory; counts how often it is made.
  float read() {
    ReferenceCache cache(folder_);
    const auto image = cache.get("key", 4, 3, [this] {
      ++made_;
      return Image(4, 3, 1, 0.25F);
    });
    EXPECT_EQ(image->width, 4);
    EXPECT_EQ(image->height, 3);
    return image->at(0, 0);
  }

  std::string folder_;
  int made_ = 0;
};

TEST_F(ReferenceCacheTest, IsMadeOnce) {
  EXPECT_EQ(read(), 0.25F);
  EXPECT_EQ(read(), 0.25F);
  EXPECT_EQ(made_, 1);
}

TEST_F(ReferenceCacheTest, AFileOfAnotherSizeOrNoPictureIsReplaced) {
  writeExr(folder_ + "/key.exr", Image(3, 4, 1, 0.5F));
  EXPECT_EQ(read(), 0.25F);
  std::ofstream(folder_ + "/key.exr") << "no picture";
  EXPECT_EQ(read(), 0.25F);
  EXPECT_EQ(made_, 2);
  EXPECT_EQ(read(), 0.25F);
  EXPECT_EQ(made_, 2);
}

}  // namespace
}  // namespace limen::experiments
