// SPDX-License-Identifier: BSD-3-Clause
// Calibration against displays whose curve is known, and against sizes worked out by hand.
#include "study/presentation/calibration.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "experiments/base/error.h"
#include "perception/psychometrics/random.h"
#include "study/presentation/calibration_screens.h"
#include "study/presentation/virtual_screen.h"

namespace limen::study {
namespace {

std::vector<Reading> readings(double black, double peak, double gamma, double noise = 0.0,
                              uint64_t seed = 0) {
  psychometrics::Random random(seed);
  std::vector<Reading> out;
  for (int i = 0; i <= 8; ++i)
    out.push_back(
        {i / 8.0, (black + (peak - black) * std::pow(i / 8.0, gamma)) * (1.0 + noise * random.normal())});
  return out;
}

TEST(Calibration, PitchFromACard) {
  // 85.60 mm over 342.4 px are 0.25 mm; over 337 px 0.25401 mm, the 20.0 in 4:3 screen of 1600 px with 406.4
  // mm.
  EXPECT_NEAR(pitchFromCard(342.4), 0.25e-3, 1e-12);
  EXPECT_NEAR(pitchFromCard(337.0) * 1600.0, 0.4064, 1e-4);
  EXPECT_THROW(pitchFromCard(0.0), Error);
  EXPECT_THROW(pitchFromCard(-5.0), Error);
  EXPECT_THROW(pitchFromCard(10.0), Error);
  EXPECT_THROW(pitchFromCard(1e6), Error);
}

TEST(Calibration, ExactReadingsGiveTheirCurveBack) {
  for (const double gamma : {1.8, 2.2, 2.6}) {
    const TransferFit fit = fitGamma(readings(0.3, 250.0, gamma));
    EXPECT_NEAR(fit.gamma, gamma, 1e-6);
    EXPECT_NEAR(fit.blackCdM2, 0.3, 1e-5);
    EXPECT_NEAR(fit.peakCdM2, 250.0, 1e-5);
    EXPECT_LT(fit.rmsCdM2, 1e-5);
    EXPECT_EQ(fit.residualCdM2.size(), 9U);
  }
  EXPECT_EQ(fitTransfer(readings(0.3, 250.0, 2.2)).curve, perception::TransferCurve::Gamma);
}

TEST(Calibration, NoiseOfAPhotometerMovesGammaByLittle) {
  // 1 % on each of nine readings. Two of them, at levels 1/8 and 1, alone give gamma with an error of
  // sqrt(2) 0.01 / ln 8 = 0.007, black and white with 1 % each. All together do no worse; five times that.
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const TransferFit fit = fitGamma(readings(0.5, 250.0, 2.2, 0.01, seed));
    EXPECT_NEAR(fit.gamma, 2.2, 0.035) << seed;
    EXPECT_NEAR(fit.blackCdM2, 0.5, 0.05 * 0.5);
    EXPECT_NEAR(fit.peakCdM2, 250.0, 0.05 * 250.0);
    EXPECT_GT(fit.rmsCdM2, 0.0);
  }
}

TEST(Calibration, SrgbIsToldFromAPower) {
  std::vector<Reading> srgb;
  for (int i = 0; i <= 16; ++i) {
    const double u = i / 16.0;
    const double light = u <= 0.04045 ? u / 12.92 : std::pow((u + 0.055) / 1.055, 2.4);
    srgb.push_back({u, 0.2 + 199.8 * light});
  }
  const TransferFit fit = fitTransfer(srgb);
  EXPECT_EQ(fit.curve, perception::TransferCurve::Srgb);
  EXPECT_NEAR(fit.blackCdM2, 0.2, 1e-6);
  EXPECT_NEAR(fit.peakCdM2, 200.0, 1e-6);
  EXPECT_NEAR(fitSrgb(srgb).rmsCdM2, 0.0, 1e-6);
}

TEST(Calibration, BadReadingsAreRefused) {
  const auto refused = [](std::vector<Reading> bad) {
    try {
      fitTransfer(bad);
    } catch (const Error& error) {
      return !error.hint().empty();
    }
    return false;
  };
  const std::vector<Reading> good = readings(0.3, 250.0, 2.2);
  EXPECT_FALSE(refused(good));
  EXPECT_TRUE(refused({}));
  EXPECT_TRUE(refused({good[0], good[4], good[8]}));
  EXPECT_TRUE(refused({good.begin(), good.end() - 3}));  // no white
  EXPECT_TRUE(refused({good.begin() + 3, good.end()}));  // no black
  std::vector<Reading> bad = good;
  bad[4].cdM2 = -1.0;
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad[8].level = 255.0;
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad[7].cdM2 = 20.0;  // falls
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad[6].cdM2 = 180.0;  // rises all along, and lies on no curve
  EXPECT_TRUE(refused(bad));
  for (Reading& reading : bad) reading.cdM2 = 100.0;
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad[2].cdM2 = std::nan("");
  EXPECT_TRUE(refused(bad));
  // Proportional to good ones, but no display's: squares of errors overflow, or vanish.
  for (const double factor : {1e297, 1e-297}) {
    bad = good;
    for (Reading& reading : bad) reading.cdM2 *= factor;
    EXPECT_TRUE(refused(bad)) << factor;
  }
}

TEST(Calibration, MatchesGiveGamma) {
  // 0.25 = 0.5^2 and 0.0625 = 0.25^2: gamma 2 by hand. With one match gamma = ln p / ln u.
  EXPECT_NEAR(fitMatches({{0.25, 0.5}, {0.0625, 0.25}}).gamma, 2.0, 1e-12);
  EXPECT_NEAR(fitMatches({{0.25, 0.53}}).gamma, std::log(0.25) / std::log(0.53), 1e-12);
  EXPECT_LT(fitMatches({{0.25, 0.53}, {0.5, 0.73}}).largestResidual, 0.01);
  EXPECT_THROW(fitMatches({}), Error);
  EXPECT_THROW(fitMatches({{0.0, 0.5}}), Error);
  EXPECT_THROW(fitMatches({{0.5, 1.0}}), Error);
  EXPECT_THROW(fitMatches({{0.53, 0.25}}), Error);               // the wrong way round
  EXPECT_THROW(fitMatches({{0.25, 0.40}, {0.5, 0.85}}), Error);  // gammas 1.5 and 4.3
}

ScreenEvent key(const char* name) { return {ScreenEvent::Kind::Key, name, {}, 0}; }

TEST(CalibrationScreens, TheFrameEnclosesACardOfTheWidthThatIsTaken) {
  VirtualDisplay display;
  display.events = {{1, key("up")}, {2, key("up")}, {3, key("left")}, {5, key("enter")}};
  VirtualScreen screen(display);
  EXPECT_EQ(adjustCardWidth(screen, 320.4), 339.0);  // 320 + 10 + 10 - 1
  // Inner edges of the last frame's lines: 339 wide, 339 * 53.98 / 85.60 = 213.8 high.
  const auto& lines = screen.shown().back().items;
  ASSERT_EQ(lines.size(), 4U);
  const auto &top = lines[0], &bottom = lines[1], &left = lines[2], &right = lines[3];
  EXPECT_EQ(right.atPx.x - (left.atPx.x + left.sizePx.x), 339.0);
  EXPECT_EQ(bottom.atPx.y - (top.atPx.y + top.sizePx.y), 214.0);
  EXPECT_EQ(top.sizePx.x, 339.0 + left.sizePx.x + right.sizePx.x);
}

TEST(CalibrationScreens, TheFieldHasTheShareOfWhiteRowsAndTheLevelIsTaken) {
  for (const double proportion : kMatchProportions) {
    VirtualDisplay display;
    display.events = {{1, key("right")}, {2, key("right")}, {3, key("down")}, {4, key("enter")}};
    VirtualScreen screen(display);
    const std::optional<double> level = adjustMatch(screen, proportion, 0.6);  // code 153
    ASSERT_TRUE(level.has_value());
    EXPECT_NEAR(*level, 145.0 / 255.0, 1e-9);
    const auto& items = screen.shown().back().items;
    EXPECT_NEAR(items.back().light, 145.0 / 255.0, 1e-9);
    // All but the square are white rows of one pixel in a field as high as wide.
    const double field = items[0].sizePx.x;
    EXPECT_EQ(static_cast<double>(items.size() - 1), proportion * field);
    for (size_t i = 0; i + 1 < items.size(); ++i) EXPECT_EQ(items[i].sizePx, glm::dvec2(field, 1.0));
  }
}

TEST(CalibrationScreens, EscapeAndALostWindowGiveUp) {
  VirtualDisplay display;
  display.events = {{2, key("escape")}};
  VirtualScreen screen(display);
  EXPECT_FALSE(adjustCardWidth(screen, 300.0).has_value());
  VirtualDisplay losing;
  losing.lostAt = 3;
  VirtualScreen gone(losing);
  EXPECT_FALSE(adjustMatch(gone, 0.5, 0.5).has_value());
}

class CalibrationFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("limen_calibration_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string write(const std::string& text) const {
    const std::string path = (folder_ / "readings.csv").string();
    std::ofstream(path) << text;
    return path;
  }
  std::filesystem::path folder_;
};

TEST_F(CalibrationFile, ReadsReadingsAndNamesTheLineThatIsWrong) {
  const auto read = readReadings(write("level,cd_m2\n# dark room\n0, 0.25\r\n0.5;48.5 # middle\n\n1\t250\n"));
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read[1].level, 0.5);
  EXPECT_EQ(read[1].cdM2, 48.5);
  EXPECT_EQ(read[2].cdM2, 250.0);
  try {
    readReadings(write("0,0.25\n0.5,bright\n"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.where().find("readings.csv:2"), std::string::npos);
  }
  EXPECT_THROW(readReadings((folder_ / "none.csv").string()), Error);
}

TEST_F(CalibrationFile, ReadsMatches) {
  const auto matches = parseMatches("0.25=0.53, 0.5=0.72");
  ASSERT_EQ(matches.size(), 2U);
  EXPECT_EQ(matches[1].proportion, 0.5);
  EXPECT_EQ(matches[1].level, 0.72);
  EXPECT_THROW(parseMatches("0.25:0.53"), Error);
  EXPECT_THROW(parseMatches("a=b"), Error);
}

TEST_F(CalibrationFile, AProfileIsReadBackAndNeverOverwrittenUnasked) {
  perception::DisplayProfile profile = perception::displayPreset("desktop_24");
  profile.name = "lab";
  profile.gamma = 2.31;
  profile.transfer = perception::TransferCurve::Gamma;
  const std::string path = (folder_ / "lab.yaml").string();
  writeProfile(path, profile, {"calibrated by hand"}, false);
  // What a process has read it never overwrites, asked to or not: a copy is read.
  const std::string copy = (folder_ / "copy.yaml").string();
  std::filesystem::copy_file(path, copy);
  EXPECT_EQ(perception::readDisplay(copy).hash(), profile.hash());
  EXPECT_THROW(writeProfile(path, profile, {}, false), Error);
  profile.gamma = 2.4;
  writeProfile(path, profile, {}, true);
  EXPECT_EQ(perception::readDisplay(path).gamma, 2.4);
  profile.peakCdM2 = 0.0;
  EXPECT_THROW(writeProfile((folder_ / "bad.yaml").string(), profile, {}, true), Error);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "bad.yaml"));
}

}  // namespace
}  // namespace limen::study
