// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/reference_cache.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

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
    return read(cache);
  }
  float read(ReferenceCache& cache) {
    const Reference reference = cache.get("key", 4, 3, [this] {
      ++made_;
      return Reference{std::make_shared<const Image>(4, 3, 1, 0.25F), {tracer_}};
    });
    EXPECT_EQ(reference.image->width, 4);
    EXPECT_EQ(reference.image->height, 3);
    EXPECT_EQ(reference.remarks, std::vector<std::string>{"by " + madeBy_});
    return reference.image->at(0, 0);
  }

  std::string folder_;
  std::string tracer_ = "by the CPU",
              madeBy_ = "the CPU";  // what makes references now, and made the one read
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

// A reference of another day says what made it then, not what would make it now.
TEST_F(ReferenceCacheTest, RemarksComeWithThePictureFromMemoryAndDisk) {
  read();
  tracer_ = "by the GPU";
  read();
  ReferenceCache cache(folder_);
  read(cache);
  read(cache);
  EXPECT_EQ(made_, 1);
}

// Without them nobody could say what made the picture, as with those of earlier versions.
TEST_F(ReferenceCacheTest, APictureWithoutItsRemarksIsMadeAgain) {
  read();
  tracer_ = "by the GPU", madeBy_ = "the GPU";
  std::filesystem::remove(folder_ + "/key.json");
  read();
  EXPECT_EQ(made_, 2);
  for (const char* damaged : {"", "{\"remarks\": [", "[]", "{\"remarks\": [1]}"}) {
    std::ofstream(folder_ + "/key.json") << damaged;
    read();
  }
  EXPECT_EQ(made_, 6);
}

// Locks tell openings of a file apart, not processes, and the image library's threads do not survive a fork.
TEST_F(ReferenceCacheTest, OfSeveralThatNeedItAtOnceOneMakesIt) {
  std::atomic<int> made{0}, right{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i)
    threads.emplace_back([&] {
      ReferenceCache cache(folder_);
      const Reference reference = cache.get("key", 4, 3, [&] {
        ++made;
        // Long enough for the others to come.
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        return Reference{std::make_shared<const Image>(4, 3, 1, 0.25F), {}};
      });
      right += reference.image->at(3, 2) == 0.25F ? 1 : 0;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(made, 1);
  EXPECT_EQ(right, 3);
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    EXPECT_NE(entry.path().extension(), ".lock") << "nothing is left behind";
}

TEST_F(ReferenceCacheTest, AProcessThatDiesWhileItMakesOneHoldsNobodyUp) {
  const pid_t child = fork();
  if (child == 0) {
    ReferenceCache cache(folder_);
    cache.get("key", 4, 3, []() -> Reference { _exit(9); });
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_EQ(WEXITSTATUS(status), 9);
  EXPECT_EQ(read(), 0.25F);
}

}  // namespace
}  // namespace limen::experiments
