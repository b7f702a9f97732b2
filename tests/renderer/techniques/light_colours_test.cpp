// SPDX-License-Identifier: BSD-3-Clause
// Coloured and textured lights: the sums themselves, the mask's against brute force on the scene's geometry,
// and against shadow rays to each part of the light.
#include "renderer/techniques/soft_shadows/bitmask_coloured/light_colours.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <glm/gtc/packing.hpp>

#include "experiments/base/error.h"
#include "renderer/scene/shapes.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr const char *kColoured = "soft_shadows/bitmask_coloured",
                     *kTraced = "soft_shadows/ray_traced_colours";

glm::dvec3 entryOf(const std::vector<glm::uvec2>& table, size_t at) {
  const glm::vec2 redGreen = glm::unpackHalf2x16(table[at].x), blue = glm::unpackHalf2x16(table[at].y);
  return {redGreen.x, redGreen.y, blue.x};
}

std::vector<glm::dvec3> randomShares(size_t count) {
  scene::Random random(7);
  std::vector<glm::dvec3> shares;
  glm::dvec3 sum(0.0);
  for (size_t i = 0; i < count; ++i) {
    shares.emplace_back(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0), random.uniform(0.0, 1.0));
    sum += shares.back();
  }
  for (glm::dvec3& share : shares) share /= sum;
  return shares;
}

/// A half has 11 significant bits: each entry is off by 2^-11 of itself at most (2^-25 where it is tiny), and
/// so is their sum.
TEST(LightColours, TableHoldsTheSumsOfAllPatternsToHalfPrecision) {
  for (const size_t count : {size_t{13}, size_t{32}, size_t{64}})
    for (const int bits : {4, 8}) {
      const std::vector<glm::dvec3> shares = randomShares(count);
      const std::vector<glm::uvec2> table = colourTable(shares, bits);
      const size_t patterns = size_t{1} << bits, groups = (count + size_t(bits) - 1) / size_t(bits);
      ASSERT_EQ(table.size(), groups * patterns);
      for (size_t group = 0; group < groups; ++group)
        for (size_t pattern = 0; pattern < patterns; ++pattern) {
          glm::dvec3 expected(0.0);
          for (size_t bit = 0; bit < size_t(bits); ++bit)
            if ((pattern >> bit & 1U) && group * size_t(bits) + bit < count)
              expected += shares[group * size_t(bits) + bit] * double(count);
          const glm::dvec3 found = entryOf(table, group * patterns + pattern);
          for (int channel = 0; channel < 3; ++channel)
            ASSERT_NEAR(found[channel], expected[channel], expected[channel] * 0x1p-11 + 0x1p-25)
                << count << " samples, groups of " << bits << ", " << group << ", " << pattern;
        }
    }
}

/// The masks divide the samples; each channel's shares sum to one light.
TEST(LightColours, MasksDivideTheSamples) {
  const scene::Scene scene = scene::buildScene(
      "two_colour_light",
      ParameterValues(scene::SceneRegistry::instance().get("two_colour_light").allParameters(), {}));
  for (const char* pattern : {"regular_8", "jittered_16", "regular_32", "halton_256"})
    for (const bool cells : {false, true}) {
      if (cells && !isGridPattern(fromText<LightPattern>(pattern))) continue;
      const std::vector<glm::dvec2> samples = lightSamples(fromText<LightPattern>(pattern));
      const int side = static_cast<int>(std::lround(std::sqrt(double(samples.size()))));
      const std::vector<glm::dvec3> shares = emissionShares(scene.lights[0], samples, cells ? side : 0);
      const std::vector<ColourMask> masks = colourMasks(shares);
      ASSERT_EQ(masks.size(), 2U) << pattern;
      glm::dvec3 sum(0.0);
      for (size_t word = 0; word < masks[0].mask.size(); ++word) {
        EXPECT_EQ(masks[0].mask[word] & masks[1].mask[word], 0U);
        EXPECT_EQ(masks[0].mask[word] | masks[1].mask[word], 0xffffffffU);
        for (const ColourMask& colour : masks) sum += double(std::popcount(colour.mask[word])) * colour.share;
      }
      for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(sum[channel], 1.0, 1e-12) << pattern;
    }
}

/// A cell that a part's edge cuts takes its share of the part, exactly.
TEST(LightColours, CellsTakeTheMeanOfWhatTheyHold) {
  scene::AreaLight light;
  // A triangle over half of the light: left of the diagonal from the lower left to the upper right corner.
  light.parts = {{{{0.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}, {1.0F, 0.0F, 2.0F}}};
  const std::vector<glm::dvec2> samples = lightSamples(LightPattern::Regular8);
  const std::vector<glm::dvec3> shares = emissionShares(light, samples, 8);
  for (size_t i = 0; i < samples.size(); ++i) {
    const size_t column = i % 8, row = i / 8;
    // 28 whole cells and 8 halves.
    const double expected = (column < row ? 1.0 : column == row ? 0.5 : 0.0) / 32.0;
    EXPECT_NEAR(shares[i].x, expected, 1e-12) << i;
    EXPECT_EQ(shares[i].y, 0.0);
    EXPECT_NEAR(shares[i].z, expected, 1e-12) << i;
  }
}

class ColouredLight : public TechniqueTest {
 protected:
  static scene::Scene halfPlaneUnder(std::vector<scene::LightPart> parts) {
    scene::Scene scene = makeScene("half_plane");
    scene.lights[0].parts = std::move(parts);
    return scene;
  }
};

/// Every way to add up gives the sum over the samples that the half-plane, in true geometry, leaves: samples
/// whose ray passes its edge by less than 2e-3 of the light may go either way. The picture on the light has
/// no symmetry, so that a flip or a turn of it would show.
TEST_F(ColouredLight, SumsWhatTheSamplesInSightEmit) {
  const std::vector<scene::LightPart> picture = makeScene("textured_light").lights[0].parts;
  for (const auto& [colours, group] : {std::pair<const char*, int64_t>("masks", 0),
                                       {"table", 4},
                                       {"table", 8},
                                       {"table", 16},
                                       {"samples", 0}}) {
    const std::string what = std::string(colours) + " " + std::to_string(group);
    scene::Scene scene = halfPlaneUnder(picture);
    scene::AreaLight& light = scene.lights[0];
    Given given = {{"resolution", int64_t{64}},
                   {"budget.limit", int64_t{0}},
                   {"pattern.prefilter", false},
                   {"pattern", std::string("jittered_16")},
                   {"colours", std::string(colours)}};
    if (group > 0) given["colours.group_bits"] = group;
    const Rendered result = render(scene, kColoured, given, {32, 24});
    const std::vector<glm::dvec2> samples = lightSamples(LightPattern::Jittered16);
    std::vector<glm::dvec3> emitted;
    glm::dvec3 whole(0.0);
    for (const glm::dvec2 sample : samples) {
      // Cells of the picture from its own layout: rows of eight, from the lower left corner.
      const auto cell = static_cast<size_t>(sample.y * 8.0) * 8 + static_cast<size_t>(sample.x * 8.0);
      emitted.emplace_back(picture.at(cell).radiance);
      whole += emitted.back();
    }
    int coloured = 0;
    for (int y = 0; y < result.product.height; ++y)
      for (int x = 0; x < result.product.width; ++x) {
        EXPECT_EQ(result.product.at(x, y, 3), 1.0F);
        if (result.receivers.at(x, y, 3) < 0.0F) {
          for (int channel = 0; channel < 3; ++channel) EXPECT_EQ(result.product.at(x, y, channel), 1.0F);
          continue;
        }
        const glm::dvec3 p = light.centre + light.axisX * double(result.receivers.at(x, y, 0)) +
                             light.axisY * double(result.receivers.at(x, y, 1)) +
                             light.direction() * double(result.receivers.at(x, y, 2));
        if (std::abs(p.y) > 1e-3) continue;  // the card's own top
        glm::dvec3 low(0.0), high(0.0);
        for (size_t i = 0; i < samples.size(); ++i) {
          const glm::dvec3 to = light.point(samples[i]);
          const double atEdge = (1.0 - p.y) / (to.y - p.y);
          const double beyond = (p.x + atEdge * (to.x - p.x)) / atEdge / light.size.x;
          if (beyond > 2e-3) low += emitted[i];
          if (beyond > -2e-3) high += emitted[i];
        }
        glm::dvec3 found;
        for (int channel = 0; channel < 3; ++channel) {
          found[channel] = result.product.at(x, y, channel);
          // Halves are off by 2^-11 of the sum; sums of 256 floats by less than 2^-16.
          const double rounding = 0x1p-11 + 0x1p-16;
          EXPECT_GE(found[channel], low[channel] / whole[channel] - rounding) << what;
          EXPECT_LE(found[channel], high[channel] / whole[channel] + rounding) << what;
        }
        coloured += std::abs(found.x - found.z) > 0.02;
      }
    EXPECT_GT(coloured, 10) << what;
  }
}

/// With both halves of the light in one colour all channels are the visibility; with one dark half red and
/// blue are each other's complement on the samples: weights of the colours sum to V.
TEST_F(ColouredLight, WeightsOfTheColoursSumToTheVisibility) {
  const std::vector<glm::dvec2> left = {{0.0, 0.0}, {0.5, 0.0}, {0.5, 1.0}, {0.0, 1.0}},
                                right = {{0.5, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.5, 1.0}};
  scene::Scene scene = makeScene("two_boxes", {{"light_size", 3.0}});
  const Given settings = {{"resolution", int64_t{128}}};
  const Image plain = render(scene, "soft_shadows/bitmask", settings, {48, 36}).product;
  scene.lights[0].parts = {{left, {1.0F, 0.0F, 0.0F}}, {right, {0.0F, 0.0F, 1.0F}}};
  for (const char* colours : {"masks", "table", "samples"}) {
    Given given = settings;
    given["colours"] = std::string(colours);
    const Image product = render(scene, kColoured, given, {48, 36}).product;
    bool differs = false;
    for (size_t i = 0; i < plain.pixels(); ++i) {
      const double red = product.data[4 * i], blue = product.data[4 * i + 2];
      EXPECT_NEAR(0.5 * (red + blue), plain.data[i], 0x1p-11 + 0x1p-16) << colours;
      // The light has no green, and none is missing.
      EXPECT_EQ(product.data[4 * i + 1], 1.0F);
      differs |= std::abs(red - blue) > 0.25;
    }
    EXPECT_TRUE(differs);
  }
}

TEST_F(ColouredLight, ALightOfOneColourIsItsVisibility) {
  for (const char* shape : {"rectangle", "disc"}) {
    const scene::Scene scene =
        makeScene("two_boxes", {{"light_size", 3.0}, {"light_shape", std::string(shape)}});
    const Given settings = {
        {"resolution", int64_t{128}}, {"maps", std::string("peeled")}, {"pattern", std::string("regular_8")}};
    const Image plain = render(scene, "soft_shadows/bitmask", settings, {48, 36}).product;
    const Image product = render(scene, kColoured, settings, {48, 36}).product;
    for (size_t i = 0; i < plain.pixels(); ++i)
      for (size_t channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(product.data[4 * i + channel], plain.data[i], 0x1p-11 + 0x1p-16) << shape;
  }
}

/// Two references of their own making: rays to each part, and the exact visible area of a light that is one
/// part alone. The channel of a part that nothing else emits is that part's visibility.
TEST_F(ColouredLight, RaysSeeEachPartAsALightOfItsOwn) {
  constexpr int kSamples = 256;
  const std::vector<glm::dvec2> part = {{0.1, 0.0}, {0.6, 0.2}, {0.5, 1.0}};
  scene::Scene scene = makeScene("two_boxes", {{"light_size", 3.0}});
  scene.lights[0].parts = {{part, {0.0F, 0.5F, 0.0F}}, {{}, {2.0F, 0.0F, 0.0F}}};
  const Rendered colours = render(scene, kTraced, {{"samples", int64_t{kSamples}}}, {40, 30});
  scene.lights[0].parts = {{}};
  const Image whole = render(scene, "soft_shadows/exact_union", {}, {40, 30}).product;
  scene.lights[0].shape = scene::LightShape::Polygon;
  scene.lights[0].outline = part;
  const Image alone = render(scene, "soft_shadows/exact_union", {}, {40, 30}).product;
  // Hoeffding, for all pixels and both channels at once to 99.9 %.
  const double bound = std::sqrt(std::log(2e3 * 2 * 1200) / (2.0 * kSamples));
  for (size_t i = 0; i < whole.pixels(); ++i) {
    EXPECT_NEAR(colours.product.data[4 * i], whole.data[i], bound);
    EXPECT_NEAR(colours.product.data[4 * i + 1], alone.data[i], bound);
    EXPECT_EQ(colours.product.data[4 * i + 2], 1.0F);
  }
}

/// A file, black on the left and white on the right, under a pixel filter of its own: the light's right half
/// and nothing else emits.
class PicturedLight : public ColouredLight {
 protected:
  static constexpr glm::ivec2 kSize{40, 30};
  void SetUp() override {
    ColouredLight::SetUp();
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    file_ = testing::TempDir() + "pictured_light_" + info->name() + ".png";
    Image half(6, 5, 3, 0.0F);
    for (int y = 0; y < 5; ++y)
      for (int x = 3; x < 6; ++x)
        for (int channel = 0; channel < 3; ++channel) half.at(x, y, channel) = 1.0F;
    writePng(file_, half);
  }
  void TearDown() override {
    std::remove(file_.c_str());
    ColouredLight::TearDown();
  }
  scene::Scene pictured(int64_t cells) const {
    return makeScene("two_boxes", {{"light_size", 3.0},
                                   {"light_shape", std::string("picture")},
                                   {"light_shape.file", file_},
                                   {"light_shape.cells", cells}});
  }
  static scene::Scene rightHalf() {
    scene::Scene scene = makeScene("two_boxes", {{"light_size", 3.0}});
    scene.lights[0].parts = {{{{0.5, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.5, 1.0}}, glm::vec3(1.0F)}};
    return scene;
  }

 private:
  std::string file_;
};

TEST_F(PicturedLight, OfTwoHalvesIsALightOfTwoHalves) {
  for (const char* pattern : {"regular_8", "jittered_16", "halton_256"})
    for (const char* colours : {"masks", "table", "samples"}) {
      const Given given = {
          {"resolution", int64_t{128}}, {"pattern", std::string(pattern)}, {"colours", std::string(colours)}};
      const Image expected = render(rightHalf(), kColoured, given, kSize).product;
      for (const int64_t cells : {2, 10}) {
        const Image found = render(pictured(cells), kColoured, given, kSize).product;
        // Cells of a tenth do not fall on those of the samples, whose areas are sums then.
        for (size_t i = 0; i < found.data.size(); ++i)
          ASSERT_NEAR(found.data[i], expected.data[i], 0x1p-11 + 0x1p-16) << pattern << colours << cells;
      }
    }
}

TEST_F(PicturedLight, HasTheVisibilityOfItsBrightHalf) {
  constexpr int kSamples = 256;
  scene::Scene half = rightHalf();
  half.lights[0].shape = scene::LightShape::Polygon;
  half.lights[0].outline = half.lights[0].parts[0].outline;
  half.lights[0].parts = {{}};
  const Image exact = render(half, "soft_shadows/exact_union", {}, kSize).product;
  const Image traced = render(pictured(2), kTraced, {{"samples", int64_t{kSamples}}}, kSize).product;
  const Image masked = render(pictured(2), kColoured, {}, kSize).product;
  // Two parts of equal weight. Hoeffding for all pixels at once to 99.9 %.
  const double bound = std::sqrt(std::log(2e3 * 1200) / (2.0 * 2 * kSamples));
  double squares = 0.0, mirrored = 0.0;
  for (size_t i = 0; i < exact.pixels(); ++i) {
    for (size_t channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(traced.data[4 * i + channel], exact.data[i], bound);
    squares += std::pow(masked.data[4 * i] - double(exact.data[i]), 2.0);
  }
  scene::Scene left = half;
  left.lights[0].outline = {{0.0, 0.0}, {0.5, 0.0}, {0.5, 1.0}, {0.0, 1.0}};
  const Image other = render(left, "soft_shadows/exact_union", {}, kSize).product;
  for (size_t i = 0; i < exact.pixels(); ++i)
    mirrored += std::pow(masked.data[4 * i] - double(other.data[i]), 2.0);
  // 128 samples across the bright half, were they independent, err by sqrt(V (1 - V) / 128) <= 0.044; what
  // the map gets wrong besides is less than what the wrong half would.
  EXPECT_LT(std::sqrt(squares / double(exact.pixels())), 0.044);
  EXPECT_LT(squares, 0.25 * mirrored);
}

TEST_F(ColouredLight, WhatDoesNotGoTogetherIsRefused) {
  const std::vector<Parameter>& declared = TechniqueRegistry::instance().get(kColoured).parameters;
  for (const Given& given :
       {Given{{"colours", std::string("masks")}, {"colours.group_bits", int64_t{4}}},
        Given{{"pattern", std::string("halton_256")}, {"pattern.prefilter", false}},
        // Colours follow from masks, of one level each.
        Given{{"levels", std::string("blend")}}})
    EXPECT_THROW(ParameterValues(declared, given), Error) << given.rbegin()->first;
  // A picture of 32 x 32 cells has more colours than masks are for.
  EXPECT_THROW(render(makeScene("textured_light", {{"cells", int64_t{32}}}), kColoured,
                      {{"colours", std::string("masks")}}, {8, 8}),
               Error);
}

}  // namespace
}  // namespace limen::techniques
