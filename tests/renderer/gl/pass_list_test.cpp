// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/pass_list.h"

#include <chrono>
#include <thread>

#include "tests/renderer/gl/gl_fixture.h"

namespace limen::gl {
namespace {

class PassListTest : public GlTest {
 protected:
  /// One frame of two passes, the first of which keeps the host busy for `milliseconds`.
  static void frame(PassList& passes, int milliseconds) {
    passes.beginFrame();
    {
      const auto scope = passes.open("slow");
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    }
    { const auto scope = passes.open("quick"); }
    passes.endFrame();
  }
};

TEST_F(PassListTest, WallTimesHoldWhatThePassTook) {
  PassList passes;
  frame(passes, 0);
  passes.startRecording(Clock::Wall, 3);
  for (int i = 0; i < 3; ++i) frame(passes, 4);
  const std::vector<PassTime> times = passes.finishRecording();
  ASSERT_EQ(times.size(), 9U);
  for (int i = 0; i < 3; ++i) {
    const PassTime &slow = times[3 * i], &quick = times[3 * i + 1], &whole = times[3 * i + 2];
    EXPECT_EQ(slow.frame, i);
    EXPECT_EQ(slow.pass, "slow");
    EXPECT_EQ(quick.pass, "quick");
    EXPECT_EQ(whole.pass, "frame");
    EXPECT_GE(slow.nanoseconds, 4000000);
    EXPECT_GE(quick.nanoseconds, 0);
    EXPECT_GE(whole.nanoseconds, slow.nanoseconds + quick.nanoseconds);
  }
}

TEST_F(PassListTest, GpuTimesAreReadOnceRecordingHasEnded) {
  PassList passes;
  frame(passes, 0);
  passes.startRecording(Clock::Gpu, 2);
  for (int i = 0; i < 2; ++i) frame(passes, 0);
  const std::vector<PassTime> times = passes.finishRecording();
  EXPECT_EQ(times.size(), 6U);
}

TEST_F(PassListTest, FramesPastTheCapacityAreNotRecorded) {
  PassList passes;
  frame(passes, 0);
  passes.startRecording(Clock::Wall, 1);
  for (int i = 0; i < 3; ++i) frame(passes, 0);
  EXPECT_EQ(passes.finishRecording().size(), 3U);
}

/// Frames or passes alone: what is not asked for leaves no time, whatever else is recorded.
TEST_F(PassListTest, FramesAndPassesAreRecordedApart) {
  PassList passes;
  frame(passes, 0);
  const auto names = [&](Recorded what) {
    passes.startRecording(Clock::Wall, 2, what);
    for (int i = 0; i < 2; ++i) frame(passes, 0);
    std::vector<std::string> out;
    for (const PassTime& time : passes.finishRecording())
      out.push_back(std::to_string(time.frame) + time.pass);
    return out;
  };
  EXPECT_EQ(names(Recorded::Frames), (std::vector<std::string>{"0frame", "1frame"}));
  EXPECT_EQ(names(Recorded::Passes), (std::vector<std::string>{"0slow", "0quick", "1slow", "1quick"}));
}

TEST_F(PassListTest, NothingIsRecordedUnlessAsked) {
  PassList passes;
  frame(passes, 0);
  EXPECT_TRUE(passes.finishRecording().empty());
}

TEST_F(PassListTest, APassThatDidNotRunLeavesNoTimeAndSaysSo) {
  PassList passes;
  frame(passes, 0);
  passes.startRecording(Clock::Wall, 1);
  passes.beginFrame();
  { const auto scope = passes.open("quick"); }
  passes.endFrame();
  EXPECT_EQ(passes.finishRecording().size(), 2U);
  EXPECT_FALSE(passes.passes()[0].ran);
  EXPECT_TRUE(passes.passes()[1].ran);
}

TEST_F(PassListTest, APassFirstSeenInATimedFrameIsAProgrammersError) {
  PassList passes;
  frame(passes, 0);
  passes.startRecording(Clock::Wall, 1);
  passes.beginFrame();
  EXPECT_THROW(passes.open("unknown"), std::logic_error);
  passes.finishRecording();
}

TEST_F(PassListTest, BytesAreKeptByPass) {
  PassList passes;
  passes.setBytesHeld("a", 10);
  passes.setBytesHeld("b", 20);
  passes.setBytesHeld("a", 30);
  ASSERT_EQ(passes.passes().size(), 2U);
  EXPECT_EQ(passes.passes()[0].bytesHeld, 30);
  EXPECT_EQ(passes.passes()[1].bytesHeld, 20);
}

}  // namespace
}  // namespace limen::gl
