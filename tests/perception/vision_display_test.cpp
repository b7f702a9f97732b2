// SPDX-License-Identifier: BSD-3-Clause
#include "perception/vision/display.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>

#include "experiments/base/error.h"
#include "perception/vision/colour.h"
#include "perception/vision/eye_movement.h"

namespace limen::perception {
namespace {

namespace fs = std::filesystem;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class DisplayFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "limen_display_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string write(const std::string& text) const {
    const fs::path path = folder_ / "lab.yaml";
    std::ofstream(path) << text;
    return path.string();
  }
  /// What the error says about a file of this text.
  std::string complaint(const std::string& text) const {
    try {
      readDisplay(write(text));
    } catch (const Error& error) {
      return error.what();
    }
    return "no complaint";
  }
  fs::path folder_;
};

// Worked out in the specification for the study's set-up.
TEST(Display, StudySetUp) {
  DisplayProfile display = displayPreset("schwarz_2009");
  EXPECT_NEAR(1000.0 * display.pitchM(), 0.2540, 5.1e-5);
  EXPECT_NEAR(display.pixelsPerDegree(), 41.229, 5.1e-4);
  EXPECT_NEAR(0.5 * display.pixelsPerDegree(), 20.61, 5.1e-3);
  EXPECT_NEAR(display.pixelsPerDegreeAt(512.0), 43.16, 5.1e-3 + 0.005) << "centre of the pixel at the edge";
  EXPECT_NEAR(display.areaDeg2({1024.0, 768.0}), 24.46 * 18.47, 0.3);
  EXPECT_NEAR(std::log2(display.pixelsPerDegree()), 5.366, 5.1e-4);
  EXPECT_EQ(display.blackCdM2, 0.5);
  EXPECT_EQ(display.peakCdM2, 250.0);
  // The same panel taken for one of 20.1 in.
  display.widthM *= 20.1 / 20.0;
  EXPECT_NEAR(display.pixelsPerDegree(), 41.024, 5.1e-4);
}

TEST(Display, PixelsPerDegreeOffTheCentre) {
  const DisplayProfile display = displayPreset("desktop_24");
  // d theta / dx = d / (d^2 + x^2): off the centre a pixel is smaller by 1 + (x / d)^2.
  const double x = 500.0 * display.pitchM() / display.distanceM;
  EXPECT_NEAR(display.pixelsPerDegreeAt(500.0) / display.pixelsPerDegreeAt(0.0), 1.0 + x * x, 1e-6);
  EXPECT_EQ(display.pixelsPerDegreeAt(-500.0), display.pixelsPerDegreeAt(500.0));
  // The pixel at the centre against a degree's worth of pixels: tan is that much more than linear.
  EXPECT_NEAR(display.pixelsPerDegree() / display.pixelsPerDegreeAt(0.0), 1.0, 3e-5);
}

TEST(Display, LuminanceLiesBetweenBlackAndWhite) {
  DisplayProfile display = displayPreset("desktop_24");
  display.ambientLux = 100.0 * M_PI;
  display.screenReflectance = 0.01;
  EXPECT_NEAR(display.reflectedCdM2(), 1.0, 1e-12) << "E rho / pi";
  EXPECT_NEAR(display.luminanceCdM2({0, 0, 0}), 1.25, 1e-12);
  EXPECT_NEAR(display.luminanceCdM2({1, 1, 1}), 251.0, 1e-9);
  const glm::dvec3 white = display.xyz({1, 1, 1}), black = display.xyz({0, 0, 0});
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(white[i], 251.0 * whiteXyz()[i], 1e-4);
    EXPECT_NEAR(black[i], 1.25 * whiteXyz()[i], 1e-12);
  }
  for (const auto& rgb : {std::array<double, 3>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.2, 0.5, 0.9}})
    EXPECT_NEAR(display.xyz(rgb).y, display.luminanceCdM2(rgb), 1e-12) << "one Y for both";
  EXPECT_NEAR(display.luminanceCdM2({1, 0, 0}), 249.75 * 0.2126729 + 1.25, 1e-4);
}

TEST(Display, DecodingTakesAnything) {
  DisplayProfile display;
  for (const TransferCurve curve : {TransferCurve::Srgb, TransferCurve::Gamma, TransferCurve::Linear}) {
    display.transfer = curve;
    EXPECT_EQ(display.decode(kNan), 0.0);
    EXPECT_EQ(display.decode(-3.0), 0.0);
    EXPECT_EQ(display.decode(0.0), 0.0);
    EXPECT_NEAR(display.decode(1.0), 1.0, 1e-12);
    EXPECT_TRUE(std::isfinite(display.decode(kInfinity)));
    EXPECT_EQ(display.decode(2.0), curve == TransferCurve::Linear ? 2.0 : 1.0);
  }
  display.transfer = TransferCurve::Gamma;
  display.gamma = 2.0;
  EXPECT_DOUBLE_EQ(display.decode(0.5), 0.25);
  EXPECT_EQ(display.luminanceCdM2({kNan, -1.0, 0.0}), display.blackLevelCdM2());
}

TEST(Display, PresetsAreValidAndDiffer) {
  std::set<std::string> hashes;
  for (const std::string& name : displayPresets()) {
    const DisplayProfile display = displayPreset(name);
    EXPECT_NO_THROW(checkDisplay(display, name));
    EXPECT_FALSE(displayPresetReason(name).empty()) << name;
    EXPECT_NE(display.line().find(name), std::string::npos);
    EXPECT_TRUE(hashes.insert(display.hash()).second) << name;
  }
  EXPECT_GE(hashes.size(), 7u);
  EXPECT_THROW(displayPreset("desktop_42"), Error);
}

TEST(Display, HashIsOfWhatIsSeen) {
  const DisplayProfile display = displayPreset("desktop_24");
  DisplayProfile other = display;
  other.name = "renamed";
  other.gamma = 1.8;  // without effect on sRGB
  EXPECT_EQ(other.hash(), display.hash());
  other.distanceM += 1e-9;
  EXPECT_NE(other.hash(), display.hash());
}

TEST_F(DisplayFile, ReadsBackWhatItWrites) {
  for (const std::string& name : displayPresets()) {
    DisplayProfile display = displayPreset(name);
    display.name = "left \"lab\" \\ 2";
    const DisplayProfile back = readDisplay(write(toYaml(display)));
    EXPECT_EQ(back.hash(), display.hash()) << name;
    EXPECT_EQ(back.name, display.name);
    EXPECT_EQ(readDisplay(name).hash(), display.hash());
  }
}

TEST_F(DisplayFile, DocumentedExample) {
  const DisplayProfile display = readDisplay(
      write("# 24 in desktop display\nname: lab_left\nresolution_px: [1920, 1080]\ndiagonal_in: "
            "24\ndistance_m: 0.6\n"
            "black_cd_m2: 0.25\npeak_cd_m2: 250\nambient_lux: 200\nscreen_reflectance: 0.01\ntransfer: srgb\n"
            "refresh_hz: 60\n"));
  EXPECT_EQ(display.name, "lab_left");
  EXPECT_EQ(display.hash(), displayPreset("desktop_24").hash());
}

TEST_F(DisplayFile, NameIsTheFilesWithoutOne) {
  EXPECT_EQ(readDisplay(write("resolution_px: [100, 100]\nsize_m: [0.1, 0.1]\ndistance_m: 1\nblack_cd_m2: 0\n"
                              "peak_cd_m2: 100\n"))
                .name,
            "lab");
}

TEST_F(DisplayFile, ErrorsNameTheLine) {
  const std::string good =
      "resolution_px: [100, 100]\nsize_m: [0.1, 0.1]\ndistance_m: 1\nblack_cd_m2: 0\n"
      "peak_cd_m2: 100\n";
  const auto expect = [&](const std::string& text, const std::string& where, const std::string& what) {
    const std::string said = complaint(text);
    EXPECT_NE(said.find("lab.yaml" + where), std::string::npos) << said;
    EXPECT_NE(said.find(what), std::string::npos) << said;
  };
  expect(good + "refresh_hertz: 60\n", ":6:1", "did you mean 'refresh_hz'?");
  expect(good + "distance_m: 2\n", ":6:1", "given twice");
  expect(good + "refresh_hz: fast\n", ":6:13", "'fast'");
  expect(good + "refresh_hz: .nan\n", ":6:13", "give a number");
  expect(good + "refresh_hz: -1\n", ":6:13", "allowed: 0.1 to 10000");
  expect(good + "transfer: srbg\n", ":6:11", "did you mean 'srgb'?");
  expect(good + "gamma: 2\n", ":6:8", "transfer: gamma");
  expect(good + "transfer: gamma\n", "", "'gamma' is missing");
  expect(good + "diagonal_in: 4\n", ":6:14", "keep one");
  expect(good + "name: [a]\n", ":6:7", "not a text");
  expect("resolution_px: [100]\n", ":1:16", "[width, height]");
  expect("resolution_px: [100.5, 100]\n", ":1:16", "whole numbers");
  expect("resolution_px: [1e300, 100]\n", ":1:16", "whole numbers");
  expect("resolution_px: [100, 100]\nsize_m: [0.1, 0.2]\ndistance_m: 1\nblack_cd_m2: 0\npeak_cd_m2: 100\n",
         ":2:9", "not square");
  expect("resolution_px: [100, 100]\nsize_m: [0.1, 0.1]\ndistance_m: 1\nblack_cd_m2: 9\npeak_cd_m2: 8\n",
         ":5:13", "not above");
  expect("resolution_px: [100, 100]\nsize_m: [0.1, 0.1]\nblack_cd_m2: 9\npeak_cd_m2: 80\n", "",
         "'distance_m' is missing");
  expect("a: [1\n", ":", "list of 'key: value'");
  expect("- 1\n", "", "no map");
  expect("", "", "no map");
  expect(std::string(70000, '#'), "", "too large");
  EXPECT_THROW(readDisplay(folder_.string()), Error);
  EXPECT_THROW(readDisplay((folder_ / "none.yaml").string()), Error);
}

TEST(EyeMovement, LiteralVanishesAndSaturates) {
  const auto literal = [](double v) { return retinalVelocityDegS(v, EyeMovement::Literal); };
  EXPECT_DOUBLE_EQ(literal(0.0), 0.15);
  EXPECT_NEAR(literal(0.15 / 0.18), 0.0, 1e-15) << "the eye keeps up exactly";
  EXPECT_NEAR(literal(97.378), 17.378, 5.1e-4);
  EXPECT_NEAR(literal(97.378 + 1.0), 18.378, 5.1e-4) << "from there the eye is left behind";
  EXPECT_NEAR(literal(200.0), 120.0, 1e-12);
}

TEST(EyeMovement, FloorAndMonotoneNeverVanish) {
  double last = 0.0;
  for (double v = 0.0; v < 300.0; v += 0.01) {
    const double literal = retinalVelocityDegS(v, EyeMovement::Literal);
    EXPECT_GE(retinalVelocityDegS(v, EyeMovement::Floor), 0.15);
    EXPECT_GE(retinalVelocityDegS(v, EyeMovement::Floor), literal);
    const double monotone = retinalVelocityDegS(v, EyeMovement::Monotone);
    EXPECT_GE(monotone, std::max(last, 0.15));
    last = monotone;
    EXPECT_EQ(retinalVelocityDegS(v, EyeMovement::None), v);
  }
  // 0.18 v - 0.15 passes 0.15 at v = 1.667.
  EXPECT_DOUBLE_EQ(retinalVelocityDegS(1.6), 0.15);
  EXPECT_NEAR(retinalVelocityDegS(10.0), 1.65, 1e-12);
  EXPECT_DOUBLE_EQ(retinalVelocityDegS(0.8, EyeMovement::Floor, 0.1), 0.1);
}

TEST(EyeMovement, TakesAnything) {
  for (const EyeMovement model :
       {EyeMovement::Literal, EyeMovement::Floor, EyeMovement::Monotone, EyeMovement::None}) {
    EXPECT_EQ(retinalVelocityDegS(kNan, model), retinalVelocityDegS(0.0, model));
    EXPECT_EQ(retinalVelocityDegS(-5.0, model), retinalVelocityDegS(0.0, model));
    EXPECT_TRUE(std::isfinite(retinalVelocityDegS(kInfinity, model)));
    EXPECT_TRUE(std::isfinite(retinalVelocityDegS(1.0, model, kNan)));
  }
}

TEST(EyeMovement, ScreenVelocity) {
  // One pixel a frame at 60 Hz and 41.229 pixels a degree: 1.455 deg/s.
  EXPECT_NEAR(screenVelocityDegS(1.0, 60.0, 41.229), 1.45529, 5e-6);
}

}  // namespace
}  // namespace limen::perception
