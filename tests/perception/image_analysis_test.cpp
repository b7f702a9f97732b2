// SPDX-License-Identifier: BSD-3-Clause
// Connected components against a flood fill, optical flow against known motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "perception/image_analysis/connected_components.h"
#include "perception/image_analysis/optical_flow.h"

namespace limen::perception {
namespace {

/// Row by row, each pixel without a label floods what it reaches.
std::vector<uint32_t> flooded(const std::vector<uint8_t>& mask, int width, int height, int connectivity) {
  std::vector<uint32_t> labels(mask.size(), 0);
  uint32_t count = 0;
  for (int start = 0; start < width * height; ++start) {
    if (!mask[static_cast<size_t>(start)] || labels[static_cast<size_t>(start)]) continue;
    labels[static_cast<size_t>(start)] = ++count;
    std::vector<int> open = {start};
    while (!open.empty()) {
      const int x = open.back() % width, y = open.back() / width;
      open.pop_back();
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          if (connectivity == 4 && dx != 0 && dy != 0) continue;
          if (x + dx < 0 || x + dx >= width || y + dy < 0 || y + dy >= height) continue;
          const auto next = static_cast<size_t>((y + dy) * width + x + dx);
          if (!mask[next] || labels[next]) continue;
          labels[next] = count;
          open.push_back(static_cast<int>(next));
        }
    }
  }
  return labels;
}

TEST(ConnectedComponents, AreThoseOfAFloodFillInTheOrderOfTheirFirstPixels) {
  std::mt19937 random(5);
  const int sizes[][2] = {{1, 1}, {1, 37}, {41, 1}, {2, 2}, {7, 3}, {64, 64}, {65, 33}, {131, 97}};
  for (const auto& [width, height] : sizes)
    for (const int connectivity : {4, 8})
      // Near 0.41 and 0.59 the components of a plane begin to join: the most intricate ones.
      for (const double density : {0.0, 0.1, 0.41, 0.5, 0.59, 0.9, 1.0})
        for (int round = 0; round < 4; ++round) {
          std::vector<uint8_t> mask(static_cast<size_t>(width) * static_cast<size_t>(height));
          std::bernoulli_distribution inside(density);
          for (uint8_t& value : mask) value = inside(random) ? static_cast<uint8_t>(1 + random() % 255) : 0;
          ASSERT_EQ(connectedComponents(mask, width, height, connectivity),
                    flooded(mask, width, height, connectivity))
              << width << " x " << height << ", " << connectivity << " neighbours, density " << density;
        }
}

/// A smooth pattern, sampled anywhere: waves of 9 to 40 pixels in all directions.
float pattern(double x, double y) {
  double sum = 0.0;
  const double waves[][3] = {{0.31, 0.12, 0.3}, {-0.21, 0.44, 1.1}, {0.09, -0.27, 2.0},
                             {0.52, 0.33, 0.7}, {-0.4, -0.16, 4.2}, {0.15, 0.05, 5.1}};
  for (const auto& [u, v, phase] : waves) sum += std::sin(u * x + v * y + phase);
  return static_cast<float>(0.5 + sum / 14.0);
}

Image shifted(int width, int height, double dx, double dy, int channels) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c) image.at(x, y, c) = pattern(x - dx, y - dy);
  return image;
}

// The content of the second picture has moved by (dx, dy). A quarter of a pixel is what dense inverse search
// reaches on such patterns (Kroeger et al. 2016 report less than a pixel on real ones); a wrong sign, swapped
// axes or swapped pictures would be off by whole pixels.
TEST(OpticalFlow, FindsAKnownTranslation) {
  const double motions[][2] = {{3.0, 0.0}, {0.0, -2.0}, {-4.0, 1.5}, {0.5, 0.25}, {6.0, 5.0}};
  for (const auto& [dx, dy] : motions)
    for (const int channels : {1, 3}) {
      const Image flow = opticalFlow(shifted(160, 120, 0, 0, channels), shifted(160, 120, dx, dy, channels));
      ASSERT_EQ(flow.channels, 2);
      double worst = 0.0, sum = 0.0;
      int count = 0;
      for (int y = 16; y < 104; ++y)
        for (int x = 16; x < 144; ++x, ++count) {
          const double error = std::hypot(flow.at(x, y, 0) - dx, flow.at(x, y, 1) - dy);
          worst = std::max(worst, error);
          sum += error;
        }
      EXPECT_LT(sum / count, 0.1) << dx << ", " << dy;
      EXPECT_LT(worst, 0.25) << dx << ", " << dy;
    }
}

TEST(OpticalFlow, IsZeroWhereNothingChanges) {
  const Image image = shifted(90, 70, 0, 0, 3);
  for (const float value : opticalFlow(image, image).data) EXPECT_NEAR(value, 0.0F, 1e-3F);
}

TEST(OpticalFlow, TakesPicturesOfAnySize) {
  for (const int width : {1, 5, 17, 64, 100})
    for (const int height : {1, 9, 63}) {
      const Image flow = opticalFlow(shifted(width, height, 0, 0, 1), shifted(width, height, 1, 0, 1));
      EXPECT_EQ(flow.width, width);
      EXPECT_EQ(flow.height, height);
      for (const float value : flow.data) EXPECT_TRUE(std::isfinite(value));
    }
}

TEST(OpticalFlow, IsTheSameEveryTime) {
  const Image a = shifted(130, 110, 0, 0, 3), b = shifted(130, 110, 2.3, -1.2, 3);
  EXPECT_EQ(opticalFlow(a, b).data, opticalFlow(a, b).data);
}

}  // namespace
}  // namespace limen::perception
