// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <queue>

#include "experiments/base/error.h"
#include "perception/popping/detection.h"
#include "perception/popping/overlay.h"
#include "perception/popping/regions.h"
#include "perception/popping/weights.h"
#include "tests/perception/popping_images.h"

namespace limen::perception {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// '#': 2 JND and a seed, '+': 3 JND and no seed, '.': nothing.
struct Drawing {
  std::vector<double> jnd;
  std::vector<uint8_t> seeds;
  int width, height;
  explicit Drawing(const std::vector<std::string>& rows)
      : width(static_cast<int>(rows[0].size())), height(static_cast<int>(rows.size())) {
    for (const std::string& row : rows)
      for (const char c : row)
        jnd.push_back(c == '#' ? 2.0 : c == '+' ? 3.0 : 1.999), seeds.push_back(c == '#');
  }
  RegionMap find(const PoppingSettings& settings = {}) const {
    return findRegions(jnd, seeds, width, height, settings);
  }
};

// As printed in the specification: R = 0, 1, 2, 3 at Sigma = 2.667, 6, 13.5, 30.375.
TEST(PoppingRating, MatchesThePublishedMapping) {
  EXPECT_NEAR(poppingRating(8.0 / 3.0), 0.0, 1e-12);
  EXPECT_NEAR(poppingRating(6.0), 1.0, 1e-12);
  EXPECT_NEAR(poppingRating(13.5), 2.0, 1e-12);
  EXPECT_NEAR(poppingRating(30.375), 3.0, 1e-12);
  EXPECT_EQ(poppingRating(0.0), -kInfinity);
}

TEST(PoppingRegions, OnePixelAtTheThreshold) {
  const RegionMap map = Drawing({"...", ".#.", "..."}).find();
  ASSERT_EQ(map.regions.size(), 1U);
  const PoppingRegion& region = map.regions[0];
  EXPECT_NEAR(region.sigma, 2.0, 1e-12);
  EXPECT_NEAR(region.rating, -0.355, 5e-4);
  EXPECT_EQ(region.sizePx, 1);
  EXPECT_EQ(region.centroidPx, glm::dvec2(1.5, 1.5));
  EXPECT_NEAR(region.coverage, 1.0 / 9.0, 1e-15);
}

// Sigma = (2^2.4 + 3^2.4 + 3^2.4)^(1/2.4).
TEST(PoppingRegions, StatisticsByHand) {
  const RegionMap map = Drawing({"#....", "+....", ".+..."}).find();
  ASSERT_EQ(map.regions.size(), 1U);
  const PoppingRegion& region = map.regions[0];
  EXPECT_NEAR(region.sigma, std::pow(std::pow(2.0, 2.4) + 2.0 * std::pow(3.0, 2.4), 1.0 / 2.4), 1e-12);
  EXPECT_EQ(region.least, glm::ivec2(0, 0));
  EXPECT_EQ(region.most, glm::ivec2(1, 2));
  EXPECT_EQ(region.largestJnd, 3.0);
  EXPECT_NEAR(region.centroidPx.x, 2.5 / 3.0, 1e-12);
  EXPECT_NEAR(region.centroidPx.y, 1.5, 1e-12);
  EXPECT_EQ(map.at(0, 1), &region);
  EXPECT_EQ(map.at(4, 0), nullptr);
  EXPECT_EQ(map.at(-1, 0), nullptr);
  EXPECT_EQ(map.at(0, 3), nullptr);
}

TEST(PoppingRegions, DiagonalsCountForEightNeighboursOnly) {
  const Drawing drawing({"#..", ".#.", "..#"});
  EXPECT_EQ(drawing.find().regions.size(), 1U);
  PoppingSettings settings;
  settings.regions.connectivity = 4;
  EXPECT_EQ(drawing.find(settings).regions.size(), 3U);
}

TEST(PoppingRegions, WithoutASeedTheyVanish) {
  const RegionMap map = Drawing({"++.++", ".....", "+#.++"}).find();
  ASSERT_EQ(map.regions.size(), 1U);
  EXPECT_EQ(map.regions[0].sizePx, 2);
  EXPECT_EQ(map.labels[0], 0U);
  EXPECT_EQ(map.labels[10], 1U);
}

TEST(PoppingRegions, QueriesCountPixels) {
  const RegionMap map = Drawing({"#.##", "#.##", "#..."}).find();
  const auto shares = map.in({0, 0}, {3, 1});
  ASSERT_EQ(shares.size(), 2U);
  EXPECT_EQ(shares[0].pixels, 4);
  EXPECT_EQ(shares[0].region->label, 2U);
  EXPECT_EQ(shares[1].pixels, 2);
  EXPECT_TRUE(map.in({1, 0}, {1, 9}).empty());
  Image mask(4, 3, 1);
  EXPECT_EQ(map.coverageOf(mask), 0.0);
  mask.at(0, 0) = mask.at(1, 0) = mask.at(2, 0) = mask.at(1, 1) = 1.0F;
  EXPECT_EQ(map.coverageOf(mask), 0.5);
}

// Against the words of the thesis: from each seed, take neighbours of at least the threshold until none is
// left.
TEST(PoppingRegions, MatchGrowingFromSeeds) {
  for (const int connectivity : {4, 8})
    for (const double density : {0.2, 0.41, 0.6}) {
      const int w = 53, h = 47;
      const Image noise = noiseImage(w, h, 1, 3), seedNoise = noiseImage(w, h, 1, 4);
      std::vector<double> jnd(noise.data.size());
      std::vector<uint8_t> seeds(noise.data.size());
      for (size_t p = 0; p < jnd.size(); ++p) {
        jnd[p] = noise.data[p] < density ? 2.0 + noise.data[p] : 1.0;
        seeds[p] = seedNoise.data[p] < 0.05F;
      }
      std::vector<int> grown(jnd.size(), 0);
      int count = 0;
      for (int start = 0; start < w * h; ++start) {
        if (!seeds[start] || jnd[start] < 2.0 || grown[start]) continue;
        grown[start] = ++count;
        std::queue<int> open({start});
        while (!open.empty()) {
          const int x = open.front() % w, y = open.front() / w;
          open.pop();
          for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
              if (connectivity == 4 && dx * dy != 0) continue;
              const int nx = x + dx, ny = y + dy;
              if (nx < 0 || ny < 0 || nx >= w || ny >= h) continue;
              if (jnd[ny * w + nx] < 2.0 || grown[ny * w + nx]) continue;
              grown[ny * w + nx] = count;
              open.push(ny * w + nx);
            }
        }
      }
      PoppingSettings settings;
      settings.regions.connectivity = connectivity;
      const RegionMap map = findRegions(jnd, seeds, w, h, settings);
      ASSERT_EQ(map.regions.size(), static_cast<size_t>(count));
      // The same partition, numbered otherwise.
      std::vector<uint32_t> labelOf(static_cast<size_t>(count) + 1, 0);
      for (size_t p = 0; p < grown.size(); ++p) {
        if (grown[p] == 0) {
          ASSERT_EQ(map.labels[p], 0U);
          continue;
        }
        uint32_t& label = labelOf[static_cast<size_t>(grown[p])];
        if (label == 0) label = map.labels[p];
        ASSERT_EQ(map.labels[p], label);
      }
      for (size_t i = 0; i < map.regions.size(); ++i) EXPECT_EQ(map.regions[i].label, i + 1);
    }
}

TEST(PoppingRegions, NonFiniteValuesAreInNone) {
  const std::vector<double> jnd = {std::nan(""), kInfinity, 3.0};
  const RegionMap map = findRegions(jnd, {}, 3, 1, {});
  ASSERT_EQ(map.regions.size(), 1U);
  EXPECT_EQ(map.regions[0].sizePx, 1);
}

// g + (1 - g - l) / 10 at R = 1 ("rarely"), nine tenths at R = 3 ("easily").
TEST(PoppingDetection, FollowsTheThesissWords) {
  const DetectionModel model;
  const double span = 1.0 - model.guessRate - model.lapseRate;
  EXPECT_NEAR(model.probability(1.0), model.guessRate + 0.1 * span, 1e-5);
  EXPECT_NEAR(model.probability(3.0), model.guessRate + 0.9 * span, 1e-5);
  EXPECT_NEAR(model.probability(-1e9), 10.0 / 224.0, 1e-4);  // catch trials of the first study
  EXPECT_EQ(model.probability(-kInfinity), model.guessRate);
  EXPECT_EQ(model.probability(std::nan("")), model.guessRate);
  EXPECT_NEAR(model.probability(kInfinity), 1.0 - model.lapseRate, 1e-15);
}

TEST(PoppingDetection, InverseFindsTheRating) {
  const DetectionModel model;
  for (const double rating : {-2.0, 0.5, 2.0, 4.0})
    EXPECT_NEAR(model.rating(model.probability(rating)), rating, 1e-9);
  EXPECT_EQ(model.rating(0.0), -kInfinity);
  EXPECT_EQ(model.rating(1.0), kInfinity);
}

TEST(PoppingDetection, AnyOfManyGuessesOnce) {
  const DetectionModel model;
  EXPECT_NEAR(model.probabilityOfAny({}), model.guessRate, 1e-15);
  EXPECT_NEAR(model.probabilityOfAny({2.0}), model.probability(2.0), 1e-15);
  EXPECT_NEAR(model.probabilityOfAny({-kInfinity, -kInfinity}), model.guessRate, 1e-15);
  EXPECT_GT(model.probabilityOfAny({2.0, 2.0}), model.probability(2.0));
}

/// A wall at depth 1 over columns [0, edge), ground at depth 2 behind it.
Image wall(int edge) {
  Image depth(16, 8, 1, 2.0F);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < edge; ++x) depth.at(x, y) = 1.0F;
  return depth;
}

// The wall moves 4 pixels to the left: what it uncovers was hidden, the rest was seen.
TEST(PoppingWeights, UncoveredPixelsWeighNothing) {
  DisocclusionView view;
  view.previousDepth = wall(8);
  view.previousDepthOfPixel = wall(4);
  view.displacement = Image(16, 8, 2);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 4; ++x) view.displacement.at(x, y, 0) = -4.0F;
  const Image weight = disocclusionWeight({view});
  for (int x = 0; x < 16; ++x) EXPECT_EQ(weight.at(x, 3), x >= 4 && x < 8 ? 0.0F : 1.0F) << x;
  // The other level of detail has no wall: seen in one of both counts.
  DisocclusionView open = view;
  open.previousDepth = wall(0);
  EXPECT_EQ(disocclusionWeight({view, open}).at(5, 3), 1.0F);
}

TEST(PoppingWeights, ComparisonIsFiltered) {
  // Half a pixel from the edge, two of four texels hide the point.
  DisocclusionView view;
  view.previousDepth = wall(8);
  view.previousDepthOfPixel = Image(16, 8, 1, 2.0F);
  view.displacement = Image(16, 8, 2);
  for (size_t p = 0; p < 128; ++p) view.displacement.data[2 * p] = 0.5F;
  EXPECT_NEAR(disocclusionWeight({view}).at(8, 3), 0.5, 1e-6);
  DisocclusionSettings settings;
  settings.pcfRadiusPx = 1;
  // Places at 7, 8, 9: 0, 0.5 and 1.
  EXPECT_NEAR(disocclusionWeight({view}, settings).at(8, 3), 0.5, 1e-6);
  EXPECT_NEAR(disocclusionWeight({view}, settings).at(7, 3), 1.0 / 6.0, 1e-6);
}

TEST(PoppingWeights, BorderAndBackground) {
  DisocclusionView view;
  view.previousDepth = Image(4, 4, 1);  // background
  view.previousDepthOfPixel = Image(4, 4, 1, 5.0F);
  view.displacement = Image(4, 4, 2);
  view.displacement.at(0, 0, 0) = 1.0F;  // from x = -0.5
  view.displacement.at(1, 0, 0) = 1.5F;  // from x = 0, still inside
  view.displacement.at(2, 0, 0) = std::numeric_limits<float>::quiet_NaN();
  Image weight = disocclusionWeight({view});
  EXPECT_EQ(weight.at(0, 0), 0.0F);
  EXPECT_EQ(weight.at(1, 0), 1.0F);
  EXPECT_EQ(weight.at(2, 0), 1.0F);
  DisocclusionSettings settings;
  settings.outsideVisibility = 0.75;
  EXPECT_EQ(disocclusionWeight({view}, settings).at(0, 0), 0.75F);
  // A point at infinity behind anything is hidden.
  view.previousDepth = Image(4, 4, 1, 7.0F);
  view.previousDepthOfPixel = Image(4, 4, 1);
  EXPECT_EQ(disocclusionWeight({view}).at(3, 3), 0.0F);
}

FlickerInput flickerInput() {
  FlickerInput input;
  input.actual = Image(8, 8, 3, 0.5F);
  input.predicted = Image(8, 8, 3, 0.45F);
  input.previousShading = Image(8, 8, 3, 0.5F);
  input.previousFrame = Image(8, 8, 3, 0.4F);
  input.displacement = Image(8, 8, 2);
  return input;
}

TEST(PoppingWeights, FlickerNeedsAsMuchChangeOverTime) {
  FlickerInput input = flickerInput();
  EXPECT_EQ(flickerWeight(input).at(3, 3), 0.25F);
  input.previousFrame = Image(8, 8, 3, 0.49F);  // far less than between 0.5 and 0.45
  EXPECT_EQ(flickerWeight(input).at(3, 3), 1.0F);
  input = flickerInput();
  input.predicted = input.actual;  // nothing pops
  EXPECT_EQ(flickerWeight(input).at(3, 3), 1.0F);
}

TEST(PoppingWeights, FastPixelsAndOthersSurfacesDoNotFlicker) {
  FlickerInput input = flickerInput();
  FlickerSettings settings;
  settings.maxDisplacementPx = 2.0;
  input.displacement.at(3, 3, 0) = 2.0F;
  input.displacement.at(4, 3, 0) = 1.9F;
  Image weight = flickerWeight(input, settings);
  EXPECT_EQ(weight.at(3, 3), 1.0F);
  EXPECT_EQ(weight.at(4, 3), 0.25F);
  input = flickerInput();
  input.previousDepth = Image(8, 8, 1, 3.0F);
  input.previousDepthOfPixel = Image(8, 8, 1, 3.0F);
  input.previousDepthOfPixel.at(3, 3) = 2.0F;
  weight = flickerWeight(input);
  EXPECT_EQ(weight.at(3, 3), 1.0F);
  EXPECT_EQ(weight.at(4, 3), 0.25F);
}

TEST(PoppingOverlay, ColoursRegionsByRating) {
  const RegionMap map = Drawing({"#...", "....", "....", "...+"}).find();
  OverlayOptions options;
  options.outlines = false;
  const Image picture = poppingOverlay(Image(4, 4, 3, 0.5F), map, options);
  EXPECT_EQ(picture.height, 4);  // no room for a legend
  const auto colour = ratingColour(map.regions[0].rating);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(picture.at(0, 0, c), 0.65 * colour[static_cast<size_t>(c)] + 0.35 * 0.5, 1e-5);
    EXPECT_NEAR(picture.at(3, 3, c), 0.5, 1e-5);  // no seed, no region
  }
  options.outlines = true;
  EXPECT_EQ(poppingOverlay(Image(4, 4, 3, 0.5F), map, options).at(1, 1, 0), 0.0F);
  EXPECT_THROW(poppingOverlay(Image(5, 4, 3), map, options), Error);
}

TEST(PoppingOverlay, HasALegendWhereThereIsRoom) {
  RegionMap map;
  map.width = 200, map.height = 10;
  map.labels.assign(2000, 0);
  const Image picture = poppingOverlay(Image(200, 10, 1, 0.2F), map);
  EXPECT_EQ(picture.height, 10 + legendHeightPx(200));
  for (const float value : picture.data) EXPECT_TRUE(value >= 0.0F && value <= 1.0F);
}

TEST(PoppingOverlay, RatingScaleIsContinuous) {
  for (double rating = -2.0; rating < 6.0; rating += 0.01)
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(ratingColour(rating)[c], ratingColour(rating + 0.01)[c], 0.02);
  EXPECT_EQ(ratingColour(-kInfinity), ratingColour(0.0));
  EXPECT_EQ(ratingColour(kInfinity), ratingColour(4.0));
}

}  // namespace
}  // namespace limen::perception
