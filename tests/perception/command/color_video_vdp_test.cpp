// SPDX-License-Identifier: BSD-3-Clause
// limen-perceive compare with ColorVideoVDP: images and videos, files of displays, limits.
#include "perception/metrics/color_video_vdp/reference.h"
#include "tests/perception/command/perceive_fixture.h"

namespace limen::perception {
namespace {

using testing::HasSubstr;

class ColorVideoVdpCli : public PerceiveCli {
 protected:
  /// A moving wave, of which every third picture of the test is too bright in places.
  static Image picture(int frame, bool test) {
    Image image(48, 40, 3);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        for (int c = 0; c < 3; ++c) {
          double value = 0.5 + 0.2 * std::sin(0.4 * x + 0.2 * y - 0.5 * frame + c);
          if (test && frame % 3 == 1) value += 0.04 * std::sin(0.5 * x);
          image.at(x, y, c) = static_cast<float>(std::round(255.0 * value) / 255.0);
        }
    return image;
  }
  static cvvdp::Options optionsOf(const cvvdp::Display& display, double framesPerSecond) {
    cvvdp::Options out;
    out.display = display;
    out.framesPerSecond = framesPerSecond;
    out.codeSteps = 255.0;
    return out;
  }
  static cvvdp::Pair pairOf(int frames) {
    return {48, 40, frames, [](int frame) { return picture(frame, true); },
            [](int frame) { return picture(frame, false); }};
  }
  void saveSequences(int frames) const {
    for (int n = 0; n < frames; ++n) {
      save("test" + std::to_string(n) + ".png", picture(n, true));
      save("reference" + std::to_string(n) + ".png", picture(n, false));
    }
  }
  const std::vector<std::string> call_ = {"compare",
                                          "test%d.png",
                                          "reference%d.png",
                                          "--metrics",
                                          "color_video_vdp",
                                          "--set",
                                          "color_video_vdp.display=standard_fhd"};
};

TEST_F(ColorVideoVdpCli, AnImageIsScoredOnItsDisplay) {
  save("a.png", picture(1, true));
  save("b.png", picture(1, false));
  const cvvdp::Pair pair = {48, 40, 1, [](int) { return picture(1, true); },
                            [](int) { return picture(1, false); }};
  const nlohmann::json own =
      result({"compare", "a.png", "b.png", "--metrics", "color_video_vdp", "--map", "maps"});
  const cvvdp::Display desktop = cvvdp::displayOf(displayPreset("desktop_24"));
  cvvdp::Options options = optionsOf(desktop, 0.0);
  options.map = true;
  const cvvdp::ReferenceResult expected = cvvdp::evaluate(pair, options);
  EXPECT_NEAR(figure(own, "color_video_vdp"), expected.score.jod, 1e-4);
  const nlohmann::json& bands = own.at("color_video_vdp").at("bands");
  ASSERT_EQ(bands.size(), expected.score.frequenciesCpd.size());
  const double second = expected.score.frames[0][1][0];
  EXPECT_NEAR(bands[1].at("A").get<double>(), second, 1e-4 * second + 1e-5);
  const Image map = readImageFile(path("maps/color_video_vdp.exr")).image;
  for (size_t i = 0; i < map.data.size(); ++i) ASSERT_NEAR(map.data[i], expected.maps[0].data[i], 1e-4);
  const nlohmann::json hdr = result({"compare", "a.png", "b.png", "--metrics", "color_video_vdp", "--set",
                                     "color_video_vdp.display=standard_hdr_pq"});
  EXPECT_NEAR(figure(hdr, "color_video_vdp"),
              cvvdp::evaluate(pair, optionsOf(cvvdp::readDisplay("standard_hdr_pq"), 0.0)).score.jod, 1e-4);
}

// Floating-point files hold what the display is sent if the call says so: cd/m2 on a linear display.
TEST_F(ColorVideoVdpCli, FloatingPointFilesCanHoldCdM2) {
  const auto bright = [](bool test) {
    Image image = picture(1, test);
    for (float& value : image.data) value = std::exp2(8.0F * value);
    return image;
  };
  const FileForm exr{OIIO::TypeDesc::FLOAT, {}, {}};
  save("a.exr", bright(true), exr);
  save("b.exr", bright(false), exr);
  cvvdp::Options options = optionsOf(cvvdp::readDisplay("standard_hdr_linear"), 0.0);
  options.codeSteps = 0.0;
  const double expected =
      cvvdp::evaluate({48, 40, 1, [&](int) { return bright(true); }, [&](int) { return bright(false); }},
                      options)
          .score.jod;
  const nlohmann::json found = result({"compare", "a.exr", "b.exr", "--coded", "--metrics", "color_video_vdp",
                                       "--set", "color_video_vdp.display=standard_hdr_linear"});
  EXPECT_NEAR(figure(found, "color_video_vdp"), expected, 1e-4);
}

TEST_F(ColorVideoVdpCli, ASequenceWithARateIsAVideo) {
  constexpr int kFrames = 6;
  saveSequences(kFrames);
  for (const char* padding : {"replicate", "symmetric"}) {
    std::vector<std::string> words = call_;
    words.insert(words.end(),
                 {"--fps", "24", "--json", "--set", std::string("color_video_vdp.padding=") + padding});
    const experiments::CallResult answer = call(words);
    ASSERT_EQ(answer.exitCode, 0) << answer.err;
    const std::vector<nlohmann::json> lines = jsonLines(answer.out);
    ASSERT_EQ(lines.size(), kFrames + 1U);
    cvvdp::Options options = optionsOf(cvvdp::readDisplay("standard_fhd"), 24.0);
    options.padding = fromText<cvvdp::TemporalPadding>(padding);
    const cvvdp::Score expected = cvvdp::evaluate(pairOf(kFrames), options).score;
    EXPECT_NEAR(lines.back().at("overall").at("color_video_vdp_video").get<double>(), expected.jod, 1e-4);
    EXPECT_THAT(lines.back().at("sentence").get<std::string>(),
                HasSubstr("As a video of 6 frames at 24 frames/s"));
    const size_t alone = options.padding == cvvdp::TemporalPadding::Replicate ? kFrames : 0;
    for (size_t i = 0; i < alone; ++i)
      EXPECT_NEAR(figure(lines[i], "color_video_vdp"), expected.frameJod[i], 1e-4) << i;
  }
  std::vector<std::string> limited = call_;
  limited.insert(limited.end(), {"--fps", "24", "--fail-below", "color_video_vdp_video=9.99"});
  EXPECT_EQ(call(limited).exitCode, 1);
}

TEST_F(ColorVideoVdpCli, WithoutARateEachFrameIsAnImage) {
  saveSequences(2);
  std::vector<std::string> words = call_;
  words.emplace_back("--json");
  const std::vector<nlohmann::json> lines = jsonLines(call(words).out);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(figure(lines[0], "color_video_vdp"), 10.0);
  const cvvdp::Pair second = {48, 40, 1, [](int) { return picture(1, true); },
                              [](int) { return picture(1, false); }};
  EXPECT_NEAR(figure(lines[1], "color_video_vdp"),
              cvvdp::evaluate(second, optionsOf(cvvdp::readDisplay("standard_fhd"), 0.0)).score.jod, 1e-4);
  EXPECT_FALSE(lines[2].contains("overall"));
}

TEST_F(ColorVideoVdpCli, DisplaysComeFromFilesToo) {
  save("a.png", picture(1, true));
  save("b.png", picture(1, false));
  write("mine.json", R"({"mine": {"resolution": [1280, 720], "viewing_distance_meters": 0.5,
      "diagonal_size_inches": 20, "max_luminance": 120, "min_luminance": 0.3, "E_ambient": 100}})");
  const nlohmann::json found =
      result({"compare", "a.png", "b.png", "--metrics", "color_video_vdp", "--set",
              "color_video_vdp.display_file=" + path("mine.json"), "--set", "color_video_vdp.display=mine"});
  EXPECT_LT(figure(found, "color_video_vdp"), 10.0);
  EXPECT_THAT(found.at("color_video_vdp").at("display").get<std::string>(),
              HasSubstr("mine (sRGB, 0.3 to 120 cd/m2"));
  expectRefused({"compare", "a.png", "b.png", "--metrics", "color_video_vdp", "--set",
                 "color_video_vdp.display=standard_5k"},
                {"standard_5k", "did you mean", "standard_4k"});
}

}  // namespace
}  // namespace limen::perception
