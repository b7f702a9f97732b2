// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "experiments/base/error.h"
#include "perception/popping/comparator.h"
#include "perception/popping/predictor.h"
#include "perception/popping/sensitivity.h"
#include "tests/perception/popping_gratings.h"

namespace limen::perception {
namespace {

TEST(Popping, EqualFramesGiveNothing) {
  const Image image = sceneImage(120, 90, 0.4);
  const PoppingResult result = predictPopping(linearPair(image, image), studyDisplay());
  EXPECT_EQ(result.summary.largestJnd, 0.0);
  EXPECT_EQ(result.summary.signedMeanJnd, 0.0);
  EXPECT_TRUE(result.regions.regions.empty());
  EXPECT_EQ(result.summary.largestRating, -kInfinity);
  EXPECT_EQ(result.summary.detectionProbability, PoppingSettings().detection.guessRate);
}

TEST(Popping, SwappingFramesTurnsTheSignOnly) {
  const Image a = sceneImage(120, 90, 0.4), b = sceneImage(120, 90, 0.43);
  PoppingInput forward = linearPair(a, b), backward = linearPair(b, a);
  forward.actualDisplacement = backward.predictedDisplacement = noiseImage(120, 90, 2, 1, -5.0, 5.0);
  forward.predictedDisplacement = backward.actualDisplacement = noiseImage(120, 90, 2, 2, -5.0, 5.0);
  const PoppingResult one = predictPopping(forward, studyDisplay()),
                      other = predictPopping(backward, studyDisplay());
  EXPECT_EQ(one.jndExact, other.jndExact);
  EXPECT_EQ(one.regions.labels, other.regions.labels);
  EXPECT_EQ(one.summary.signedMeanJnd, -other.summary.signedMeanJnd);
  EXPECT_NE(one.summary.signedMeanJnd, 0.0);
}

// What is uniform has no contrast: documented property of the model.
TEST(Popping, UniformChangesAreNotSeen) {
  const PoppingResult result =
      predictPopping(linearPair(Image(64, 64, 3, 0.1F), Image(64, 64, 3, 0.9F)), studyDisplay());
  EXPECT_LT(result.summary.largestJnd, 1e-9);
}

TEST(Popping, LargerChangesAreSeenMore) {
  const Image base = sceneImage(100, 80, 0.40);
  double previous = -kInfinity;
  for (const double shift : {0.41, 0.43, 0.47, 0.55}) {
    const PoppingResult result = predictPopping(linearPair(sceneImage(100, 80, shift), base), studyDisplay());
    EXPECT_GT(result.summary.meanJnd, previous);
    previous = result.summary.meanJnd;
  }
}

TEST(Popping, TablesMatchDirectEvaluation) {
  PoppingInput in = linearPair(sceneImage(48, 40, 0.4), sceneImage(48, 40, 0.45));
  in.actualDisplacement = noiseImage(48, 40, 2, 1, -60.0, 60.0);
  PoppingOptions direct;
  direct.tables = false;
  std::vector<PoppingSettings> all(4, thesisSettings());
  all.emplace_back();
  all[1].sensitivity.achromatic.csf.name = "barten03";
  all[1].sensitivity.redGreen.csf.name = "martin92_rg";
  all[1].sensitivity.blueYellow.csf.name = "martin92_by";
  all[2].sensitivity.achromatic.csf.name = "kelly79", all[2].eyeMovement = NoTracking{};
  all[3].sensitivity.achromatic.csf.name = "burbeck_kelly80", all[3].eyeMovement = LiteralTracking{};
  for (const PoppingSettings& settings : all) {
    const std::vector<double> table = predictPopping(in, studyDisplay(), settings).jndExact;
    const std::vector<double> exact = predictPopping(in, studyDisplay(), settings, direct).jndExact;
    for (size_t p = 0; p < table.size(); ++p)
      ASSERT_NEAR(table[p], exact[p], 1e-6 * exact[p] + 1e-9) << settings.sensitivity.achromatic.csf.name;
  }
}

// Away from level 0 as well, over the whole range: the tables' promise is 1e-6 of the value.
TEST(Popping, SensitivityTablesKeepTheirPromise) {
  const PoppingModel model = poppingModel(1024, 768, studyDisplay(), {});
  for (const PoppingSettings& settings : {PoppingSettings{}, thesisSettings()}) {
    const Sensitivity table(model, studyDisplay(), settings, true),
        direct(model, studyDisplay(), settings, false);
    for (int level = 0; level < 5; ++level)
      for (double lgV = -3.3; lgV < 2.6; lgV += 0.173)
        for (double lgL = -4.4; lgL < 4.4; lgL += 0.61) {
          const auto a = table.at(level, std::pow(10.0, lgV), std::pow(10.0, lgL));
          const auto b = direct.at(level, std::pow(10.0, lgV), std::pow(10.0, lgL));
          for (size_t c = 0; c < 3; ++c) ASSERT_NEAR(a[c], b[c], 1e-6 * b[c] + 1e-12) << lgV << " " << lgL;
        }
  }
}

TEST(Popping, WeightsScaleTheMap) {
  PoppingInput in = linearPair(sceneImage(60, 50, 0.4), sceneImage(60, 50, 0.45));
  const std::vector<double> plain = predictPopping(in, studyDisplay()).jndExact;
  in.disocclusion = noiseImage(60, 50, 1, 1);
  in.flicker = noiseImage(60, 50, 1, 2);
  const std::vector<double> weighted = predictPopping(in, studyDisplay()).jndExact;
  PoppingSettings settings;
  settings.flicker = IgnoredWeight{};
  const std::vector<double> one = predictPopping(in, studyDisplay(), settings).jndExact;
  for (size_t p = 0; p < plain.size(); ++p) {
    const double w = in.disocclusion.data[p];
    EXPECT_DOUBLE_EQ(weighted[p], plain[p] * (w * double{in.flicker.data[p]}));
    EXPECT_DOUBLE_EQ(one[p], plain[p] * w);
  }
}

TEST(Popping, HostileInputsStayFinite) {
  const float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  DisplayProfile lightless = lightlessBlack();
  const int sizes[][2] = {{1, 1}, {1, 37}, {5, 4}, {33, 29}};
  for (const auto& size : sizes) {
    const int w = size[0], h = size[1];
    Image broken = noiseImage(w, h, 3, 1), moving = noiseImage(w, h, 2, 2, -1e4, 1e4);
    for (size_t i = 0; i < broken.data.size(); i += 5)
      broken.data[i] = i % 3 == 0 ? kNan : i % 3 == 1 ? kInf : -kInf;
    moving.data[0] = kNan, moving.data[1] = std::numeric_limits<float>::max();
    std::vector<Image> images = {Image(w, h, 3), Image(w, h, 3, 1.0F),   Image(w, h, 3, 1e30F),
                                 broken,         Image(w, h, 3, 1e-40F), noiseImage(w, h, 3, 3, 0.0, 1e5)};
    for (size_t i = 0; i < images.size(); ++i) {
      const Image &a = images[i], &b = images[(i + 1) % images.size()];
      for (const bool linear : {true, false}) {
        PoppingInput in = linearPair(a, b);
        in.linear = linear;
        in.actualDisplacement = moving;
        const PoppingResult result = predictPopping(in, lightless);
        for (const double value : result.jndExact) ASSERT_TRUE(std::isfinite(value) && value >= 0.0);
        for (const PoppingRegion& region : result.regions.regions) {
          ASSERT_TRUE(std::isfinite(region.sigma) && std::isfinite(region.rating));
          ASSERT_TRUE(region.detectionProbability > 0.0 && region.detectionProbability < 1.0);
        }
      }
    }
    if (w * h > 4) {
      EXPECT_GT(predictPopping(linearPair(broken, images[0]), lightless).flushedInputs, 0);
    }
  }
  // Black everywhere and no black level: every contrast has a denominator of 0.
  const PoppingResult black = predictPopping(linearPair(Image(32, 32, 3), Image(32, 32, 3)), lightless);
  EXPECT_GT(black.guardedContrasts, 0);
  EXPECT_EQ(predictPopping(linearPair(Image(32, 32, 3), Image(32, 32, 3)), studyDisplay()).guardedContrasts,
            0);
}

TEST(Popping, RegionsNeedADifferenceOfColour) {
  // The frames are equal but for their displacements: responses differ, colours do not.
  PoppingInput in = linearPair(noiseImage(64, 64, 3, 1), noiseImage(64, 64, 3, 1));
  in.actualDisplacement = displacementImage(64, 64, 0.0);
  in.predictedDisplacement = displacementImage(64, 64, 40.0);
  PoppingSettings settings;
  const PoppingResult seeded = predictPopping(in, studyDisplay(), settings);
  EXPECT_GT(seeded.summary.aboveThresholdPx, 0);
  EXPECT_EQ(seeded.summary.seedPx, 0);
  EXPECT_TRUE(seeded.regions.regions.empty());
  settings.regions.seeds = SeedRule::None;
  EXPECT_FALSE(predictPopping(in, studyDisplay(), settings).regions.regions.empty());
}

TEST(Popping, GreyEqualsThreeEqualChannels) {
  const Image a = noiseImage(40, 30, 1, 1), b = noiseImage(40, 30, 1, 2);
  Image a3(40, 30, 3), b3(40, 30, 3);
  for (size_t i = 0; i < a3.data.size(); ++i) a3.data[i] = a.data[i / 3], b3.data[i] = b.data[i / 3];
  EXPECT_EQ(predictPopping(linearPair(a, b), studyDisplay()).jndExact,
            predictPopping(linearPair(a3, b3), studyDisplay()).jndExact);
}

TEST(Popping, RefusesWhatDoesNotFit) {
  PoppingInput in = linearPair(Image(8, 8, 3), Image(8, 9, 3));
  EXPECT_THROW(predictPopping(in, studyDisplay()), Error);
  in.predicted = Image(8, 8, 3);
  in.actualDisplacement = Image(8, 8, 1);
  EXPECT_THROW(predictPopping(in, studyDisplay()), Error);
  in.actualDisplacement = {};
  in.flicker = Image(4, 4, 1);
  EXPECT_THROW(predictPopping(in, studyDisplay()), Error);
  in.flicker = {};
  PoppingOptions options;
  options.stages = {"difrence_0"};
  EXPECT_THROW(predictPopping(in, studyDisplay(), {}, options), Error);
  PoppingSettings settings;
  settings.sensitivity.achromatic.csf.name = "daly89";
  EXPECT_THROW(predictPopping(in, studyDisplay(), settings), Error);
  EXPECT_THROW(predictPopping({}, studyDisplay()), Error);
}

// Largest dE94, by hand: L* of linear 0.5 is 116 cbrt(0.5) - 16 = 76.069, of 0.25 it is 57.075, of greys
// alone.
TEST(PoppingComparator, FindsTheLargestColourDifference) {
  PoppingInput in = linearPair(Image(9, 7, 3, 0.5F), Image(9, 7, 3, 0.5F));
  EXPECT_EQ(largestColourDifference(in, studyDisplay()).value, 0.0);
  for (int c = 0; c < 3; ++c) in.predicted.at(4, 5, c) = 0.25F, in.predicted.at(2, 2, c) = 0.4F;
  const LargestColourDifference found = largestColourDifference(in, studyDisplay());
  EXPECT_NEAR(found.value, 76.0693 - 57.0754, 1e-3);
  EXPECT_EQ(found.x, 4);
  EXPECT_EQ(found.y, 5);
  in.linear = false;
  // Display-coded 0.5 and 0.25 decode to 0.21404 and 0.05088: L* 53.389 and 26.983.
  EXPECT_NEAR(largestColourDifference(in, studyDisplay()).value, 53.389 - 26.983, 5e-3);
}

}  // namespace
}  // namespace limen::perception
