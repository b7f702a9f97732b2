// SPDX-License-Identifier: BSD-3-Clause
// Videos: what is written is read back, and what is no video, or half of one, is one clear error.
#include "experiments/base/video.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "experiments/base/error.h"
#include "experiments/base/replace_file.h"

namespace limen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

namespace fs = std::filesystem;

class VideoTest : public testing::Test {
 protected:
  VideoTest() {
    std::string name = (fs::temp_directory_path() / "limen_video_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~VideoTest() override {
    std::error_code code;
    fs::remove_all(folder_, code);
  }
  std::string path(const std::string& name) const { return (fs::path(folder_) / name).string(); }
  std::string bytes(const std::string& name) const {
    std::ifstream in(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  /// 8-bit values; a gradient, noise on top of it, and a bright square that moves with the frame's number.
  static Image frame(int width, int height, int number, bool noisy) {
    Image image(width, height, 3);
    std::mt19937 random(static_cast<unsigned>(number));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c) {
          int value = (x * (c + 1) + y * (3 - c)) * 200 / (3 * (width + height)) + 20;
          if (noisy) value = static_cast<int>(random() % 256);
          if (std::abs(x - 4 - 2 * number) < 3 && std::abs(y - 8) < 3) value = 240;
          image.at(x, y, c) = static_cast<float>(value) * (1.0F / 255.0F);
        }
    return image;
  }
  void write(const std::string& name, int width, int height, int frames, double rate = 25.0,
             bool noisy = false) const {
    VideoWriter writer(path(name), width, height, rate);
    for (int n = 0; n < frames; ++n) writer.add(frame(width, height, n, noisy));
    writer.finish();
  }
  /// Where FFmpeg is not behind OpenCV only .avi can be written.
  bool canWrite(const std::string& ending) const {
    try {
      VideoWriter writer(path("try" + ending), 32, 32, 25.0);
      return true;
    } catch (const Error&) {
      return false;
    }
  }
  std::string refusal(const std::string& name) const {
    try {
      const VideoReader reader(path(name));
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }

  std::string folder_;
};

double psnr(const Image& a, const Image& b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.data.size(); ++i) sum += std::pow(double{a.data[i]} - b.data[i], 2);
  return -10.0 * std::log10(std::max(sum / static_cast<double>(a.data.size()), 1e-20));
}

// Quality 95 divides luma by at most 12 and chroma by at most 10 (a tenth of the tables of Annex K of the
// JPEG standard), so a coefficient is off by 6 at most, typically by 2 to 3: two codes and a half of 255 are
// 40 dB. The last pixel is checked apart. A wrong matrix, range or order of channels costs far more.
TEST_F(VideoTest, MotionJpegComesBackNearlyAsItWas) {
  for (const auto& [width, height] : {std::pair{64, 48}, {63, 47}, {160, 120}}) {
    const std::string name = std::to_string(width) + ".avi";
    write(name, width, height, 7, 29.97);
    VideoReader reader(path(name));
    EXPECT_EQ(reader.facts().width, width);
    EXPECT_EQ(reader.facts().height, height);
    EXPECT_EQ(reader.facts().frames, 7);
    EXPECT_NEAR(reader.facts().framesPerSecond, 29.97, 1e-9);
    EXPECT_EQ(reader.facts().codec, "MJPG");
    EXPECT_THAT(reader.facts().colour, HasSubstr("full range"));
    EXPECT_TRUE(reader.facts().remarks.empty());
    for (int n = 0; n < 7; ++n) {
      const Image& read = reader.frame(n);
      ASSERT_EQ(read.channels, 3);
      const Image whole = frame(width, height, n, false);
      EXPECT_GT(psnr(read, whole), 40.0) << width << ", frame " << n;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(read.at(width - 1, height - 1, c), whole.at(width - 1, height - 1, c), 12 / 255.0F) << n;
    }
  }
}

// JPEG stores grey without loss beyond rounding, and both ends of the range.
TEST_F(VideoTest, MotionJpegKeepsGreysAndTheirRange) {
  VideoWriter writer(path("grey.avi"), 32, 32, 10.0);
  const float levels[] = {0.0F, 1.0F, 16 / 255.0F, 128 / 255.0F, 235 / 255.0F};
  for (const float level : levels) writer.add(Image(32, 32, 1, level));
  writer.finish();
  VideoReader reader(path("grey.avi"));
  for (int n = 0; n < 5; ++n)
    for (const float value : reader.frame(n).data) EXPECT_NEAR(value, levels[n], 1.01F / 255.0F);
}

TEST_F(VideoTest, LosslessVideosComeBackExactly) {
  if (!canWrite(".mkv")) GTEST_SKIP() << "FFV1 needs FFmpeg behind OpenCV";
  write("a.mkv", 64, 48, 5, 60.0, true);
  VideoReader reader(path("a.mkv"));
  ASSERT_EQ(reader.facts().frames, 5);
  EXPECT_EQ(reader.facts().framesPerSecond, 60.0);
  EXPECT_EQ(reader.facts().colour, "RGB as stored");
  for (int n = 0; n < 5; ++n) EXPECT_EQ(reader.frame(n).data, frame(64, 48, n, true).data) << n;
}

TEST_F(VideoTest, FramesCanBeReadInAnyOrder) {
  write("a.avi", 48, 32, 6);
  VideoReader ordered(path("a.avi")), jumping(path("a.avi"));
  std::vector<Image> frames;
  for (int n = 0; n < 6; ++n) frames.push_back(ordered.frame(n));
  for (const int n : {3, 2, 3, 5, 0, 0, 4, 1})
    EXPECT_EQ(jumping.frame(n).data, frames[static_cast<size_t>(n)].data);
  EXPECT_THROW(jumping.frame(6), Error);
}

TEST_F(VideoTest, TheSameFramesGiveTheSameFile) {
  write("a.avi", 48, 32, 3);
  write("b.avi", 48, 32, 3);
  EXPECT_EQ(bytes("a.avi"), bytes("b.avi"));
}

TEST_F(VideoTest, WhatIsNotFinishedLeavesNothing) {
  {
    VideoWriter writer(path("a.avi"), 48, 32, 25.0);
    writer.add(frame(48, 32, 0, false));
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(VideoTest, WritersSayWhatTheyCannotDo) {
  EXPECT_THROW(VideoWriter(path("a.xyz"), 48, 32, 25.0), Error);
  EXPECT_THROW(VideoWriter(path("a.mkv"), 47, 32, 25.0), Error);
  EXPECT_THROW(VideoWriter(path("a.avi"), 48, 32, 0.0), Error);
  EXPECT_THROW(VideoWriter("/proc/none/a.avi", 48, 32, 25.0), Error);
  VideoWriter writer(path("a.avi"), 48, 32, 25.0);
  EXPECT_THROW(writer.add(Image(32, 48, 3)), Error);
}

TEST_F(VideoTest, WhatIsNoVideoIsRefused) {
  replaceFile(path("empty.avi"), "");
  replaceFile(path("text.mp4"), "#EXTM3U\n#EXTINF:10,\nhttp://example.org/a.ts\n");
  replaceFile(path("list.mkv"), "ffconcat version 1.0\nfile /etc/hostname\n");
  replaceFile(path("riff.avi"), std::string("RIFF\xF0\0\0\0AVI LIST", 16));
  fs::create_directory(path("folder.avi"));
  EXPECT_THAT(refusal("empty.avi"), AllOf(HasSubstr("empty.avi"), HasSubstr("empty")));
  EXPECT_THAT(refusal("text.mp4"), HasSubstr("does not begin like one"));
  EXPECT_THAT(refusal("list.mkv"), HasSubstr("does not begin like one"));
  EXPECT_THAT(refusal("riff.avi"), HasSubstr("riff.avi"));
  EXPECT_THAT(refusal("folder.avi"), HasSubstr("folder"));
  EXPECT_THAT(refusal("none.avi"), HasSubstr("no such video"));
}

TEST_F(VideoTest, CutOffVideosAreRefused) {
  int number = 0;
  const auto expectRefused = [&](const std::string& name, double share) {
    const std::string whole = bytes(name), cut = "cut" + std::to_string(++number) + name.substr(1);
    replaceFile(path(cut), whole.substr(0, static_cast<size_t>(share * static_cast<double>(whole.size()))));
    EXPECT_THAT(refusal(cut), HasSubstr(cut)) << share;
  };
  write("a.avi", 64, 48, 20, 25.0, true);
  for (const double share : {0.001, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9}) expectRefused("a.avi", share);
  if (!canWrite(".mkv")) return;
  write("a.mkv", 64, 48, 40, 25.0, true);
  for (const double share : {0.0001, 0.01, 0.1, 0.3, 0.5}) expectRefused("a.mkv", share);
}

// The sizes in an AVI file: of all streams in the main header, of the pictures in the stream's format. 30,000
// times 30,000 is far beyond what is allowed.
TEST_F(VideoTest, StatedSizesAreLimited) {
  write("a.avi", 64, 48, 2);
  std::string avi = bytes("a.avi");
  const auto put = [&](size_t at, uint32_t value) {
    for (int i = 0; i < 4; ++i) avi[at + static_cast<size_t>(i)] = static_cast<char>(value >> (8 * i));
  };
  const size_t main = avi.find("avih"), format = avi.find("strf");
  ASSERT_NE(main, std::string::npos);
  ASSERT_NE(format, std::string::npos);
  put(main + 8 + 32, 30000), put(main + 8 + 36, 30000);
  put(format + 8 + 4, 30000), put(format + 8 + 8, 30000);
  // The pictures say so as well: in their frame headers, big-endian, height first. 30000 is 0x7530.
  for (size_t at = avi.find("\xFF\xC0"); at != std::string::npos; at = avi.find("\xFF\xC0", at + 9))
    avi.replace(at + 5, 4, "\x75\x30\x75\x30");
  replaceFile(path("bomb.avi"), avi);
  EXPECT_THAT(refusal("bomb.avi"), HasSubstr("bomb.avi"));

  const ImageLimits before = imageLimits();
  setImageLimits({0.002, before.pixelsPerByte, 0.002});
  EXPECT_THAT(refusal("a.avi"),
              AllOf(HasSubstr("a.avi"), HasSubstr("64 x 48"), HasSubstr("--max-megapixels")));
  setImageLimits({0.004, before.pixelsPerByte, 0.004});
  EXPECT_EQ(refusal("a.avi"), "");
  setImageLimits(before);
}

// Whatever is damaged, it is read or refused.
TEST_F(VideoTest, DamagedVideosAreReadOrRefused) {
  std::vector<std::string> names = {"a.avi"};
  if (canWrite(".mkv")) names.emplace_back("a.mkv");
  if (canWrite(".mp4")) names.emplace_back("a.mp4");
  std::mt19937 random(3);
  for (const std::string& name : names) {
    write(name, 48, 32, 6);
    const std::string whole = bytes(name);
    for (int round = 0; round < 40; ++round) {
      const std::string damaged = "damaged" + std::to_string(round) + name.substr(1);
      std::string text = whole;
      const size_t among =
          round % 2 ? text.size() : std::min<size_t>(text.size(), 600);  // headers half the time
      for (unsigned n = 0; n < 1 + random() % 20; ++n) text[random() % among] = static_cast<char>(random());
      replaceFile(path(damaged), text);
      try {
        VideoReader reader(path(damaged));
        reader.frame(reader.facts().frames - 1);
      } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("damaged"));
      }
    }
  }
}

}  // namespace
}  // namespace limen
