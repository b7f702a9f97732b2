// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/shared_queue.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "experiments/base/error.h"

namespace limen::experiments {
namespace {

using testing::Each;
using testing::ElementsAre;

class SharedQueueTest : public testing::Test {
 protected:
  SharedQueueTest() { std::filesystem::remove_all(folder_), std::filesystem::create_directories(folder_); }
  ~SharedQueueTest() override { std::filesystem::remove_all(folder_); }

  const std::string folder_ =
      testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::string file_ = folder_ + "/taken";
};

TEST_F(SharedQueueTest, WhatOneHasTakenTheOtherDoesNotGet) {
  SharedQueue first(file_, 1), second(file_, 2);
  EXPECT_THAT(first.take({"a", "b"}), ElementsAre(true, true));
  EXPECT_THAT(second.take({"b", "c"}), ElementsAre(false, true));
  EXPECT_THAT(first.take({"c", "d", "a"}), ElementsAre(false, true, true));
}

TEST_F(SharedQueueTest, ATaskThatWasStartedAgainHasWhatItTook) {
  EXPECT_THAT(SharedQueue(file_, 1).take({"a", "b"}), Each(true));
  EXPECT_THAT(SharedQueue(file_, 2).take({"c"}), Each(true));
  EXPECT_THAT(SharedQueue(file_, 1).take({"a", "b", "c"}), ElementsAre(true, true, false));
}

TEST_F(SharedQueueTest, ALineThatAKilledProcessDidNotFinishTakesNothing) {
  EXPECT_THAT(SharedQueue(file_, 1).take({"abc"}), Each(true));
  std::ofstream(file_, std::ios::app) << "1 ab";
  SharedQueue second(file_, 2), third(file_, 3);
  EXPECT_THAT(second.take({"ab", "abc", "abd"}), ElementsAre(true, false, true));
  EXPECT_THAT(third.take({"ab", "abd", "x"}), ElementsAre(false, false, true));
}

TEST_F(SharedQueueTest, EachKeyGoesToOneOfManyAtOnce) {
  constexpr int kTasks = 4, kKeys = 200;
  std::vector<std::vector<bool>> got(kTasks);
  std::vector<std::thread> threads;
  for (int task = 0; task < kTasks; ++task)
    threads.emplace_back([&, task] {
      SharedQueue queue(file_, task + 1);
      for (int key = 0; key < kKeys; ++key) got[task].push_back(queue.take({std::to_string(key)})[0]);
    });
  for (std::thread& thread : threads) thread.join();
  for (int key = 0; key < kKeys; ++key) {
    int owners = 0;
    for (int task = 0; task < kTasks; ++task) owners += got[task][key] ? 1 : 0;
    EXPECT_EQ(owners, 1) << key;
  }
}

TEST_F(SharedQueueTest, AFolderThatIsGoneIsOneClearError) {
  EXPECT_THROW(SharedQueue(folder_ + "/none/taken", 1).take({"a"}), Error);
}

}  // namespace
}  // namespace limen::experiments
