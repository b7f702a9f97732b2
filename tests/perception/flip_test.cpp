// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "flip_reference.h"
#include "metric_helpers.h"
#include "perception/metrics/flip/flip_filters.h"
#include "perception/metrics/flip/flip_gpu.h"

namespace limen::perception {
namespace {

struct Result {
  double mean = 0.0;
  Image map;
};

class Flip : public testing::Test {
 protected:
  static void SetUpTestSuite() { context_ = gl::createHeadlessContext(); }
  static void TearDownTestSuite() { context_.reset(); }
  void TearDown() override { EXPECT_NO_THROW(context_->checkDebugMessages()); }

  static gl::Texture upload(const Image& image) {
    gl::Texture texture(image.channels == 1 ? gl::Format::R32F : gl::Format::RGBA32F,
                        {image.width, image.height});
    if (image.channels != 3) {
      texture.write(image);
      return texture;
    }
    Image padded(image.width, image.height, 4, 0.25F);  // alpha must not matter
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        for (int c = 0; c < 3; ++c) padded.at(x, y, c) = image.at(x, y, c);
    texture.write(padded);
    return texture;
  }

  static Result onGpu(const Image& test, const Image& reference,
                      double ppd = FlipGpu::kDefaultPixelsPerDegree) {
    FlipGpu flip(*context_, {test.width, test.height}, ppd);
    const gl::Texture a = upload(test), b = upload(reference);
    const double mean = flip.compute(a, b);
    return {mean, flip.map().read()};
  }

  static void expectReference(const Image& test, const Image& reference, double ppd,
                              const std::string& what) {
    const Result gpu = onGpu(test, reference, ppd);
    const FlipReference expected = computeFlipReference(test, reference, ppd);
    EXPECT_NEAR(gpu.mean, expected.mean, 1e-5) << what;
    double worst = 0.0;
    for (size_t i = 0; i < gpu.map.data.size(); ++i)
      worst = std::max(worst, std::abs(double{gpu.map.data[i]} - double{expected.map.data[i]}));
    EXPECT_LT(worst, 1e-3) << what;
  }

  static std::unique_ptr<gl::Context> context_;
};
std::unique_ptr<gl::Context> Flip::context_;

/// Soft gradients, a disc with a hard edge, a thin line and a little grain: what a rendered picture is made
/// of.
Image natural(int width, int height, double discX, unsigned seed) {
  Image image = randomImage(width, height, 3, seed);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = (x + 0.5) / width, v = (y + 0.5) / height;
      const bool disc = std::hypot(u - discX, v - 0.5) < 0.25, line = std::abs(u - v) * width < 1.0;
      const double shade[3] = {0.4 + 0.3 * std::sin(5.0 * u), 0.3 + 0.3 * std::cos(4.0 * v + u),
                               0.2 + 0.5 * u * v};
      for (int c = 0; c < 3; ++c) {
        const double base = line ? 0.95 : disc ? 0.15 * (c + 1) : shade[c];
        image.at(x, y, c) = static_cast<float>(std::clamp(base + 0.02 * (image.at(x, y, c) - 0.5), 0.0, 1.0));
      }
    }
  return image;
}

Image flat(int width, int height, float r, float g, float b) {
  Image image(width, height, 3);
  for (size_t i = 0; i < image.pixels(); ++i)
    image.data[3 * i] = r, image.data[3 * i + 1] = g, image.data[3 * i + 2] = b;
  return image;
}

struct Size {
  int width, height;
};
constexpr Size kSizes[] = {{1, 1}, {7, 5}, {64, 64}, {129, 97}};

TEST_F(Flip, RandomImagesMatchTheDefinition) {
  for (const Size& size : kSizes)
    for (const double ppd : {20.0, 67.02, 110.0})
      expectReference(randomImage(size.width, size.height, 3, 1), randomImage(size.width, size.height, 3, 2),
                      ppd, std::to_string(size.width) + " at " + std::to_string(ppd));
}

TEST_F(Flip, NaturalImagesMatchTheDefinition) {
  for (const Size& size : kSizes)
    for (const double ppd : {20.0, 67.02, 110.0})
      expectReference(natural(size.width, size.height, 0.45, 3), natural(size.width, size.height, 0.5, 4),
                      ppd, std::to_string(size.width) + " at " + std::to_string(ppd));
}

TEST_F(Flip, ExtremeResolutionsMatchTheDefinition) {
  for (const double ppd : {1.0, 5.0, 240.0})
    expectReference(natural(40, 33, 0.4, 5), natural(40, 33, 0.5, 6), ppd, std::to_string(ppd));
}

TEST_F(Flip, FlatImagesMatchTheDefinition) {
  const Size size{33, 17};
  const auto grey = [&](float v) { return flat(size.width, size.height, v, v, v); };
  expectReference(grey(0.2F), grey(0.8F), 67.02, "greys");
  expectReference(grey(0.5F), grey(0.501F), 67.02, "greys that hardly differ");
  expectReference(grey(0.0F), grey(0.001F), 67.02, "blacks");
  expectReference(flat(33, 17, 0.9F, 0.1F, 0.3F), flat(33, 17, 0.2F, 0.7F, 0.1F), 67.02, "colours");
  expectReference(flat(33, 17, 0.9F, 0.1F, 0.3F), natural(33, 17, 0.5, 1), 67.02, "flat and natural");
}

// CIELAB of green is (87.74, -86.18, 83.18), of blue (32.30, 79.19, -107.86). Scaled by 0.01 L*, the chromas
// are
// (-75.61, 72.98) and (25.58, -34.83): distance 55.44 + hypot(101.19, 107.81) = 203.30, the largest there is,
// which is FLIP 1. Black and white differ by 100: 100^0.7 = 25.119, 203.30^0.7 = 41.277, knee 0.4 * 41.277
// = 16.511, 0.95 + 0.05 (25.119 - 16.511) / (41.277 - 16.511) = 0.96738.
TEST_F(Flip, FlatColoursByHand) {
  EXPECT_NEAR(onGpu(flat(8, 8, 0, 1, 0), flat(8, 8, 0, 0, 1)).mean, 1.0, 1e-5);
  EXPECT_NEAR(onGpu(flat(8, 8, 0, 0, 0), flat(8, 8, 1, 1, 1)).mean, 0.96738, 1e-4);
}

TEST_F(Flip, EqualImagesGiveExactlyZero) {
  for (const Size& size : kSizes) {
    const Image image = randomImage(size.width, size.height, 3, 9);
    const Result result = onGpu(image, image);
    EXPECT_EQ(result.mean, 0.0);
    EXPECT_EQ(*std::max_element(result.map.data.begin(), result.map.data.end()), 0.0F);
  }
}

TEST_F(Flip, IsSymmetric) {
  const Image a = natural(50, 40, 0.4, 1), b = natural(50, 40, 0.6, 2);
  const Result forward = onGpu(a, b), backward = onGpu(b, a);
  EXPECT_NEAR(forward.mean, backward.mean, 1e-6);
  for (size_t i = 0; i < forward.map.data.size(); ++i)
    ASSERT_NEAR(forward.map.data[i], backward.map.data[i], 1e-5);
}

TEST_F(Flip, StaysBetweenZeroAndOne) {
  // Saturated colours in hard stripes strain every stage.
  Image a(64, 48, 3), b(64, 48, 3);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      a.at(x, y, x / 4 % 3) = 1.0F;
      b.at(x, y, (x / 4 + y / 6) % 3) = 1.0F;
    }
  for (const float value : onGpu(a, b).map.data) {
    EXPECT_GE(value, 0.0F);
    EXPECT_LE(value, 1.0F);
  }
}

TEST_F(Flip, MeanIsThatOfTheMapAndRepeatsExactly) {
  const Image a = natural(301, 203, 0.4, 1), b = natural(301, 203, 0.45, 2);
  const Result first = onGpu(a, b), second = onGpu(a, b);
  double sum = 0.0;
  for (const float value : first.map.data) sum += value;
  EXPECT_NEAR(first.mean, sum / static_cast<double>(first.map.data.size()), 1e-7);
  EXPECT_EQ(first.mean, second.mean);
  EXPECT_EQ(first.map.data, second.map.data);
}

TEST_F(Flip, VisibilityIsShownAsGrey) {
  const Image a = randomImage(30, 20, 1, 1), b = randomImage(30, 20, 1, 2);
  Image greyA(30, 20, 3), greyB(30, 20, 3);
  for (size_t i = 0; i < greyA.data.size(); ++i) greyA.data[i] = a.data[i / 3], greyB.data[i] = b.data[i / 3];
  EXPECT_EQ(onGpu(a, b).map.data, onGpu(greyA, greyB).map.data);
}

TEST_F(Flip, ValuesBeyondTheDisplayAreClamped) {
  Image a = natural(30, 20, 0.4, 1), clamped = a;
  for (size_t i = 0; i < a.data.size(); i += 7)
    a.data[i] = i % 2 ? 40.0F : -3.0F, clamped.data[i] = i % 2 ? 1.0F : 0.0F;
  const Image b = natural(30, 20, 0.6, 2);
  EXPECT_EQ(onGpu(a, b).map.data, onGpu(clamped, b).map.data);
}

TEST_F(Flip, NonFiniteTestChannelsShowTheFartherEnd) {
  const Image reference = natural(30, 20, 0.5, 2);
  Image broken = natural(30, 20, 0.4, 1), replaced = broken;
  const float kBad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                        -std::numeric_limits<float>::infinity()};
  for (size_t i = 0; i < broken.data.size(); i += 11) {
    broken.data[i] = kBad[i / 11 % 3];
    replaced.data[i] = reference.data[i] < 0.5F ? 1.0F : 0.0F;
  }
  EXPECT_EQ(onGpu(broken, reference).map.data, onGpu(replaced, reference).map.data);
}

TEST_F(Flip, ErrorGrowsWithTheDifference) {
  const Image reference = natural(40, 40, 0.5, 1);
  double previous = 0.0;
  for (const float shift : {0.01F, 0.03F, 0.1F, 0.3F}) {
    Image test = reference;
    for (float& value : test.data) value = std::min(1.0F, value + shift);
    const double mean = onGpu(test, reference).mean;
    EXPECT_GT(mean, previous);
    previous = mean;
  }
}

TEST(FlipFilters, KernelsAreNormalisedAsPublished) {
  for (const double ppd : {1.0, 20.0, 67.02, 240.0}) {
    const FlipFilters filters = makeFlipFilters(ppd);
    ASSERT_EQ(filters.sensitivity.size(), static_cast<size_t>(2 * filters.radius + 1));
    glm::dvec4 sums(0.0);
    glm::dvec3 positive(0.0), negative(0.0);
    for (const glm::vec4& tap : filters.sensitivity) sums += glm::dvec4(tap);
    for (const glm::vec4& tap : filters.features)
      positive += glm::max(glm::dvec3(tap), 0.0), negative += glm::min(glm::dvec3(tap), 0.0);
    EXPECT_NEAR(sums.x, 1.0, 1e-6);
    EXPECT_NEAR(sums.y, 1.0, 1e-6);
    EXPECT_NEAR(sums.z * sums.z + sums.w * sums.w, 1.0, 1e-6);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(positive[i], 1.0, 1e-6) << ppd;
    for (int i = 1; i < 3; ++i) EXPECT_NEAR(negative[i], -1.0, 1e-6) << ppd;
  }
}

}  // namespace
}  // namespace limen::perception
