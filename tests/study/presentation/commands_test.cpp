// SPDX-License-Identifier: BSD-3-Clause
// limen study timing-test and calibrate as a user calls them.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "perception/vision/display.h"
#include "tests/renderer/window/x_server.h"
#include "tests/run_program.h"

namespace limen::study {
namespace {

ProgramRun call(const std::string& environment, const std::string& arguments) {
  return runProgram("limen-study " + arguments, environment);
}

bool says(const ProgramRun& called, const std::string& text) {
  return called.text.find(text) != std::string::npos;
}

TEST(TimingCommand, FindsWhatAVirtualDisplayDrops) {
  const ProgramRun found = call("-u DISPLAY", "timing-test --virtual 144 --drop 30,90,91 --seconds 2 --json");
  EXPECT_EQ(found.code, 1);
  const auto report = nlohmann::json::parse(found.text);
  EXPECT_EQ(report.at("missed_blanks"), 3);
  std::vector<int> swaps;
  for (const auto& event : report.at("events")) swaps.push_back(event.at("swap").get<int>());
  EXPECT_EQ(swaps, (std::vector<int>{30, 90, 91}));
  EXPECT_NEAR(report.at("measured_hz").get<double>(), 144.0, 0.05);
  EXPECT_FALSE(report.at("fit_for_lab").get<bool>());
  EXPECT_EQ(call("-u DISPLAY", "timing-test --drop 30").code, 2);
}

TEST(TimingCommand, CallsASoftwareRendererOnAVirtualServerNoLab) {
  const test::XServer server(320, 240);
  const ProgramRun found =
      call("-u WAYLAND_DISPLAY DISPLAY=" + server.display(), "timing-test --windowed --seconds 0.5");
  EXPECT_EQ(found.code, 1) << found.text;
  for (const char* reason : {"software renderer", "no refresh rate", "not full screen", "not fit for a lab"})
    EXPECT_TRUE(says(found, reason)) << reason;
}

TEST(TimingCommand, WithoutAWindowSystemSaysSo) {
  const ProgramRun found = call("-u DISPLAY -u WAYLAND_DISPLAY", "timing-test");
  EXPECT_EQ(found.code, 2);
  EXPECT_TRUE(says(found, "no window system"));
}

class CalibrateCommand : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("limen_calibrate_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const char* name) const { return (folder_ / name).string(); }
  std::filesystem::path folder_;
  const std::string size_ =
      " --resolution-px 1920,1080 --card-width-px 311 --distance-cm 57.3 --refresh-hz 59.94 ";
};

TEST_F(CalibrateCommand, WritesAProfileFromReadings) {
  std::ofstream readings(path("readings.csv"));
  for (int i = 0; i <= 8; ++i) readings << i / 8.0 << "," << 0.3 + 249.7 * std::pow(i / 8.0, 2.35) << "\n";
  readings.close();
  const std::string arguments =
      "calibrate -o " + path("lab.yaml") + size_ + "--readings " + path("readings.csv");
  const ProgramRun made = call("-u DISPLAY", arguments);
  ASSERT_EQ(made.code, 0) << made.text;
  const perception::DisplayProfile profile = perception::readDisplay(path("lab.yaml"));
  EXPECT_EQ(profile.transfer, perception::TransferCurve::Gamma);
  EXPECT_NEAR(profile.gamma, 2.35, 1e-4);
  EXPECT_NEAR(profile.blackCdM2, 0.3, 1e-3);
  EXPECT_NEAR(profile.peakCdM2, 250.0, 0.01);
  EXPECT_NEAR(profile.widthM, 0.0856 / 311 * 1920, 1e-9);
  EXPECT_NEAR(profile.distanceM, 0.573, 1e-12);
  EXPECT_EQ(profile.refreshHz, 59.94);
  EXPECT_EQ(call("-u DISPLAY", arguments).code, 2) << "overwrites a profile";
  EXPECT_EQ(call("-u DISPLAY", arguments + " --force").code, 0);
}

TEST_F(CalibrateCommand, AsksForWhatItCannotKnow) {
  const std::string arguments = "calibrate -o " + path("lab.yaml") + size_;
  EXPECT_TRUE(says(call("-u DISPLAY", arguments), "luminance of black and white"));
  EXPECT_TRUE(says(call("-u DISPLAY", arguments + "--black-cd-m2 0.3 --peak-cd-m2 200"), "transfer curve"));
  const ProgramRun matched =
      call("-u DISPLAY", arguments + "--black-cd-m2 0.3 --peak-cd-m2 200 --match 0.25=0.5,0.0625=0.25");
  EXPECT_EQ(matched.code, 0) << matched.text;
  EXPECT_NEAR(perception::readDisplay(path("lab.yaml")).gamma, 2.0, 1e-9);
}

TEST_F(CalibrateCommand, TakesWhatIsSetByEye) {
  const test::XServer server(800, 600);
  // The server states no size: the frame begins at a card on pixels of 0.25 mm or what the server makes up;
  // it is narrowed to the least, 20 px, and widened by 300. Then three squares are taken as they are.
  // A slow machine may miss keys before the page is up: what sets the frame can be sent again and again, and
  // Return is pressed until the window is gone.
  const std::string find = "xdotool search --sync --name 'Limen calibration' ";
  std::string frame = find;
  for (int i = 0; i < 60; ++i) frame += "key Down ";
  for (int i = 0; i < 30; ++i) frame += "key Up ";
  const std::string keys =
      "export DISPLAY=" + server.display() + "\nfor round in 1 2 3; do " + frame +
      "; sleep 1; done\nwhile xdotool search --name 'Limen calibration' key Return; do sleep 0.3; done";
  std::ofstream(path("keys.sh")) << keys << "\n";
  const ProgramRun made =
      call("-u WAYLAND_DISPLAY DISPLAY=" + server.display() + " sh -c 'sh " + path("keys.sh") +
               " > /dev/null & exec \"$0\" \"$@\"'",
           "calibrate -o " + path("eye.yaml") +
               " --interactive --distance-cm 60 --refresh-hz 60 --black-cd-m2 0.3 --peak-cd-m2 200");
  ASSERT_EQ(made.code, 0) << made.text;
  const perception::DisplayProfile profile = perception::readDisplay(path("eye.yaml"));
  EXPECT_EQ(profile.resolutionPx, glm::ivec2(800, 600));
  EXPECT_NEAR(profile.widthM, 0.0856 / 320.0 * 800.0, 1e-9);
  // The squares begin at a gamma of 2.2, to the nearest code.
  EXPECT_NEAR(profile.gamma, 2.2, 0.02);
}

}  // namespace
}  // namespace limen::study
