// SPDX-License-Identifier: BSD-3-Clause
// limen-perceive on videos, and the videos that it writes.
#include "experiments/base/video.h"

#include <cmath>

#include "experiments/base/error.h"
#include "tests/perception/command/perceive_fixture.h"

namespace limen::perception {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class VideoCli : public PerceiveCli {
 protected:
  /// Waves that move to the right by `step` pixels a frame; `popped` adds a checkerboard that moves along.
  static Image picture(int frame, double step, bool popped) {
    Image image(96, 80, 3);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const double u = x - step * frame;
        double value = 0.5 + 0.1 * std::sin(0.35 * u + 0.1 * y) + 0.1 * std::sin(0.2 * y - 0.15 * u + 1.0) +
                       0.1 * std::sin(0.5 * y + 0.4 * u);
        if (popped && u > 30 && u < 54 && y > 30 && y < 50)
          value += (static_cast<int>(u / 4) + y / 4) % 2 ? 0.2 : -0.2;
        const double code = std::round(255.0 * value) / 255.0;
        for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(code);
      }
    return image;
  }
  void saveSequence(const std::string& name, int frames, double step, int poppedFrom) const {
    for (int n = 0; n < frames; ++n) {
      char number[16];
      std::snprintf(number, sizeof number, "%04d", n);
      save(name + number + ".png", picture(n, step, n >= poppedFrom));
    }
  }
  bool canWriteLossless() const {
    try {
      VideoWriter writer(path("try.mkv"), 32, 32, 25.0);
      return true;
    } catch (const Error&) {
      return false;
    }
  }
  std::vector<nlohmann::json> lines(std::vector<std::string> words) const {
    words.emplace_back("--json");
    const experiments::CallResult answer = call(words);
    EXPECT_EQ(answer.exitCode, 0) << answer.err;
    return jsonLines(answer.out);
  }
};

TEST_F(VideoCli, AVideoOfASequenceComparesAsTheSequence) {
  if (!canWriteLossless()) GTEST_SKIP() << "FFV1 needs FFmpeg behind OpenCV";
  saveSequence("a", 4, 2.0, 9);
  saveSequence("b", 4, 2.0, 2);
  const experiments::CallResult written = call({"video", "a%04d.png", "-o", "a.mkv", "--fps", "30"});
  ASSERT_EQ(written.exitCode, 0) << written.err;
  EXPECT_THAT(written.out, AllOf(HasSubstr("4 frames"), HasSubstr("30/s"), HasSubstr("lossless")));
  const std::vector<nlohmann::json> images =
                                        lines({"compare", "a%04d.png", "b%04d.png", "--metrics", "rmse,jnd"}),
                                    video = lines({"compare", "a.mkv", "b%04d.png", "--metrics", "rmse,jnd"});
  ASSERT_EQ(video.size(), 5U);
  for (size_t n = 0; n < 4; ++n) {
    EXPECT_EQ(video[n].at("figures"), images[n].at("figures")) << n;
    EXPECT_EQ(video[n].at("inputs").at("image").at("video_frame"), n + 1);
  }
  const nlohmann::json& facts = video.back().at("videos").at(0);
  EXPECT_EQ(facts.at("frames_per_second"), 30.0);
  EXPECT_EQ(facts.at("codec"), "FFV1");
  EXPECT_EQ(facts.at("colour"), "RGB as stored");
}

TEST_F(VideoCli, AnAviIsNearItsFramesAndSaysWhatItIs) {
  saveSequence("a", 3, 2.0, 9);
  ASSERT_EQ(call({"video", "a%04d.png", "-o", "a.avi"}).exitCode, 0);
  const std::vector<nlohmann::json> found = lines({"compare", "a.avi", "a%04d.png", "--metrics", "psnr"});
  // Smooth greys: see MotionJpegComesBackNearlyAsItWas.
  for (size_t n = 0; n < 3; ++n) EXPECT_GT(figure(found[n], "psnr_coded"), 40.0);
  EXPECT_THAT(call({"threshold", "a.avi"}).out,
              AllOf(HasSubstr("60 frames/s"), HasSubstr("full range"), HasSubstr("frame 3: median")));
}

TEST_F(VideoCli, PicturesStandSideBySide) {
  saveSequence("a", 2, 2.0, 9);
  save("still.png", flat(20, 10, {1.0F, 0.0F, 0.0F}));
  ASSERT_EQ(
      call({"video", "a%04d.png", "still.png", "-o", "pair.avi", "--gap", "6", "--fps", "12.5"}).exitCode, 0);
  VideoReader reader(path("pair.avi"));
  EXPECT_EQ(reader.facts().width, 96 + 6 + 20);
  EXPECT_EQ(reader.facts().height, 80);
  EXPECT_EQ(reader.facts().frames, 2);
  EXPECT_EQ(reader.facts().framesPerSecond, 12.5);
  const Image& frame = reader.frame(1);
  const Image left = picture(1, 2.0, false);
  EXPECT_NEAR(frame.at(10, 40, 0), left.at(10, 40), 0.03F);
  EXPECT_NEAR(frame.at(112, 4, 0), 1.0F, 0.03F);
  EXPECT_NEAR(frame.at(112, 4, 2), 0.0F, 0.03F);
  EXPECT_NEAR(frame.at(112, 40, 0), 0.0F, 0.03F);  // below the smaller picture
}

TEST_F(VideoCli, WrongVideosAreOneClearError) {
  saveSequence("a", 2, 2.0, 9);
  ASSERT_EQ(call({"video", "a%04d.png", "-o", "a.avi"}).exitCode, 0);
  write("empty.avi", "");
  write("text.mp4", "this is text and no video at all");
  write("cut.avi", read("a.avi").substr(0, 900));
  expectRefused({"threshold", "empty.avi"}, {"empty.avi", "empty"});
  expectRefused({"compare", "text.mp4", "a.avi"}, {"text.mp4", "does not begin like one"});
  expectRefused({"pop", "cut.avi", "a.avi"}, {"cut.avi"});
  expectRefused({"compare", "a.avi", "a0000.png", "--map", "a.avi"}, {"a.avi", "not a folder"});
  expectRefused({"video", "a.avi", "-o", "a.avi"}, {"never overwritten"});
  expectRefused({"video", "a.avi", "-o", "a.gif"}, {".avi"});
  expectRefused({"video", "a%04d.png"}, {"-o"});
  saveSequence("c", 3, 2.0, 9);
  expectRefused({"compare", "a.avi", "c%04d.png"}, {"2 frames", "3"});
  expectRefused({"pop", "a.avi", "a.avi", "--motion", "a.avi"}, {"--motion", "EXR"});
}

TEST_F(VideoCli, PopFindsMotionBetweenTheFramesOfSequences) {
  saveSequence("old", 3, 3.0, 9);
  saveSequence("new", 3, 3.0, 0);
  const std::vector<nlohmann::json> flow = lines({"pop", "old%04d.png", "new%04d.png"}),
                                    still = lines({"pop", "old%04d.png", "new%04d.png", "--motion", "none"});
  EXPECT_THAT(flow.back().at("statement").get<std::string>(), HasSubstr("motion by optical flow"));
  EXPECT_THAT(still.back().at("statement").get<std::string>(), HasSubstr("nothing moving"));
  // The first frame has none before it; then 3 pixels a frame (180 px/s, 4 degrees a second) change what is
  // seen.
  EXPECT_EQ(flow[0].at("figures"), still[0].at("figures"));
  EXPECT_THAT(flow[0].at("motion").get<std::string>(), HasSubstr("no previous frame"));
  EXPECT_EQ(flow[1].at("motion"), "optical flow");
  EXPECT_NE(figure(flow[1], "largest_jnd"), figure(still[1], "largest_jnd"));

  // The motion is known: given as maps, it predicts nearly the same.
  Image motion(96, 80, 2);
  for (size_t pixel = 0; pixel < motion.pixels(); ++pixel) motion.data[2 * pixel] = 3.0F;
  save("motion.exr", motion, {OIIO::TypeDesc::FLOAT, {}, {}});
  const nlohmann::json known = result({"pop", "old0002.png", "new0002.png", "--motion", "motion.exr"});
  const double change = std::abs(figure(known, "rating") - figure(still[2], "rating"));
  EXPECT_LT(std::abs(figure(flow[2], "rating") - figure(known, "rating")), 0.25 * change);
}

// A texture that moves is no popping, a texture that appears on the way is.
TEST_F(VideoCli, MotionCompensationLeavesWhatPops) {
  saveSequence("a", 5, 2.0, 3);
  const std::vector<nlohmann::json> still = lines({"pop", "a%04d.png"}),
                                    moved = lines({"pop", "a%04d.png", "--motion", "flow"});
  ASSERT_EQ(moved.size(), 5U);
  const auto share = [&](const nlohmann::json& frame) { return figure(frame, "coverage"); };
  // Everything moves, so everything seems to pop.
  for (size_t n = 0; n < 4; ++n) EXPECT_GT(share(still[n]), 0.5) << n;
  // Pairs 0-1, 1-2, 3-4 only move; at 2-3 the checkerboard of 23 x 19 pixels comes, 6 % of the picture.
  for (const size_t n : {0U, 1U, 3U}) EXPECT_LT(share(moved[n]), 0.02) << n;
  EXPECT_GT(share(moved[2]), 0.04);
  // What pops is the checkerboard's, however far it is seen: no more than where nothing moves, but for what
  // motion leaves of the other pairs.
  saveSequence("rest", 5, 0.0, 3);
  EXPECT_LT(share(moved[2]), share(lines({"pop", "rest%04d.png"})[2]) + 0.02);
}

}  // namespace
}  // namespace limen::perception
