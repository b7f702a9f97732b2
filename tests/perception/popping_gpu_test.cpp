// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "experiments/base/error.h"
#include "perception/popping/popping_gpu.h"
#include "perception/popping/weights.h"
#include "perception/popping/weights_gpu.h"
#include "tests/perception/popping_images.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::perception {
namespace {

using gl::Format;
using gl::Texture;

/// Textures of an input.
struct Upload {
  std::optional<Texture> textures[6];
  PoppingGpuInput input;

  static Texture upload(const Image& image, int channels) {
    Image padded(image.width, image.height, channels, 1.0F);
    for (size_t p = 0; p < image.pixels(); ++p)
      for (int c = 0; c < std::min(channels, image.channels); ++c)
        padded.data[p * static_cast<size_t>(channels) + static_cast<size_t>(c)] =
            image.data[p * static_cast<size_t>(image.channels) + static_cast<size_t>(c)];
    Texture texture(channels == 1   ? Format::R32F
                    : channels == 2 ? Format::RG32F
                                    : Format::RGBA32F,
                    {image.width, image.height});
    texture.write(padded);
    return texture;
  }

  explicit Upload(const PoppingInput& in) {
    const Image* images[6] = {
        &in.actual,       &in.predicted, &in.actualDisplacement, &in.predictedDisplacement,
        &in.disocclusion, &in.flicker};
    const int channels[6] = {in.actual.channels < 3 ? 1 : 4, in.actual.channels < 3 ? 1 : 4, 2, 2, 1, 1};
    const Texture** slots[6] = {
        &input.actual,       &input.predicted, &input.actualDisplacement, &input.predictedDisplacement,
        &input.disocclusion, &input.flicker};
    for (int i = 0; i < 6; ++i) {
      if (images[i]->data.empty()) continue;
      textures[i].emplace(upload(*images[i], channels[i]));
      *slots[i] = &*textures[i];
    }
    input.linear = in.linear;
  }
};

class PoppingGpu : public gl::GlTest {
 protected:
  struct Run {
    Image jnd;
    RegionMap regions;
    PoppingPredictorGpu::Counts counts;
  };
  static Run onGpu(const PoppingInput& in, const PoppingSettings& settings = {},
                   const DisplayProfile& display = studyDisplay()) {
    const Upload upload(in);
    PoppingPredictorGpu predictor(context(), {in.actual.width, in.actual.height}, display, settings,
                                  in.isSwitch);
    predictor.run(upload.input);
    return {predictor.jnd().read(), predictor.readRegions(), predictor.readCounts()};
  }

  /// Least threshold from `from` on with no pixel of the map within 2e-4 of its value. Single precision
  /// leaves such a pixel on either side, and one pixel can join two regions.
  static double thresholdBetweenPixels(const std::vector<double>& jnd, double from) {
    std::vector<double> sorted = jnd;
    std::sort(sorted.begin(), sorted.end());
    for (double threshold = from;; threshold *= 1.0001) {
      const auto above = std::lower_bound(sorted.begin(), sorted.end(), threshold * (1.0 - 2e-4));
      if (above == sorted.end() || *above > threshold * (1.0 + 2e-4)) return threshold;
    }
  }

  /// Difference map within 0.1 % (from 0.1 JND on; 0.0001 JND below) of the reference in double precision,
  /// and the same regions, at a threshold between the pixels' values.
  static PoppingResult expectReference(const PoppingInput& in, const std::string& what,
                                       PoppingSettings settings = {},
                                       const DisplayProfile& display = studyDisplay()) {
    SCOPED_TRACE(what);
    PoppingResult reference = predictPopping(in, display, settings);
    const double threshold = thresholdBetweenPixels(reference.jndExact, settings.regions.thresholdJnd);
    EXPECT_LT(threshold, 1.05 * settings.regions.thresholdJnd);
    if (threshold != settings.regions.thresholdJnd) {
      settings.regions.thresholdJnd = threshold;
      reference = predictPopping(in, display, settings);
    }
    const Run run = onGpu(in, settings, display);
    EXPECT_EQ(run.jnd.data.size(), reference.jndExact.size());
    double worst = 0.0;
    int64_t bad = 0;
    for (size_t p = 0; p < reference.jndExact.size(); ++p) {
      const double exact = reference.jndExact[p], got = run.jnd.data[p];
      if (!std::isfinite(got)) ++bad;
      worst = std::max(worst, std::abs(got - exact) / std::max(exact, 0.1));
    }
    EXPECT_EQ(bad, 0);
    EXPECT_LT(worst, 1e-3);
    EXPECT_EQ(run.counts.flushedInputs, reference.flushedInputs);
    EXPECT_EQ(run.counts.guardedContrasts, reference.guardedContrasts);
    largest_ = std::max(largest_, worst);
    // The same map gives the same regions, and so do both maps.
    const std::vector<double> asDouble(run.jnd.data.begin(), run.jnd.data.end());
    std::vector<uint8_t> seeds;
    if (settings.regions.seeds == SeedRule::ColourDiffers) {
      seeds.resize(asDouble.size());
      for (size_t p = 0; p < seeds.size(); ++p) {
        const auto channels = static_cast<size_t>(in.actual.channels);
        for (size_t c = 0; c < std::min<size_t>(channels, 3); ++c) {
          const float a = in.actual.data[p * channels + c], b = in.predicted.data[p * channels + c];
          if ((std::isfinite(a) ? a : 0.0F) != (std::isfinite(b) ? b : 0.0F)) seeds[p] = 1;
        }
      }
    }
    expectSameRegions(run.regions, findRegions(asDouble, seeds, in.actual.width, in.actual.height, settings),
                      1e-5);
    expectSameRegions(run.regions, reference.regions, 5e-3);
    return reference;
  }

  static void expectSameRegions(const RegionMap& got, const RegionMap& expected, double tolerance) {
    EXPECT_EQ(got.labels, expected.labels);
    ASSERT_EQ(got.regions.size(), expected.regions.size());
    for (size_t i = 0; i < got.regions.size(); ++i) {
      const PoppingRegion &a = got.regions[i], &b = expected.regions[i];
      EXPECT_EQ(a.label, b.label);
      EXPECT_EQ(a.sizePx, b.sizePx);
      EXPECT_EQ(a.least, b.least);
      EXPECT_EQ(a.most, b.most);
      EXPECT_NEAR(a.sigma, b.sigma, tolerance * b.sigma);
      EXPECT_NEAR(a.largestJnd, b.largestJnd, tolerance * b.largestJnd);
      EXPECT_NEAR(a.centroidPx.x, b.centroidPx.x, 1e-9);
      EXPECT_NEAR(a.centroidPx.y, b.centroidPx.y, 1e-9);
      EXPECT_EQ(a.coverage, b.coverage);
    }
  }

  inline static double largest_ = 0.0;
};

TEST_F(PoppingGpu, SwitchesAgreeOverTime) {
  PoppingInput in = linearPair(sceneImage(200, 150, 0.45), sceneImage(200, 150, 0.452));
  in.isSwitch = true;
  expectReference(in, "at rest");
  in.actualDisplacement = Image(200, 150, 2);
  in.predictedDisplacement = Image(200, 150, 2);
  for (int y = 0; y < 150; ++y)
    for (int x = 0; x < 200; ++x) {
      in.actualDisplacement.at(x, y, 0) = 0.1F * static_cast<float>(x);
      in.predictedDisplacement.at(x, y, 0) = 0.11F * static_cast<float>(x);
      in.actualDisplacement.at(x, y, 1) = in.predictedDisplacement.at(x, y, 1) =
          0.02F * static_cast<float>(y);
    }
  const PoppingResult held = expectReference(in, "moving up to 30 deg/s");
  PoppingSettings settings;
  settings.temporal = TemporalChannels{.windowS = 0.8, .holdShare = 0.25};
  const PoppingResult flashed = expectReference(in, "shown for a quarter of a frame", settings);
  EXPECT_GT(flashed.summary.meanJnd, held.summary.meanJnd);
  settings = {};
  settings.bands.weights = FittedWeights{};
  expectReference(in, "fitted weights", settings);
  settings = {};
  settings.neighbourhood = ExtendedMasking{};
  const PoppingResult masked = expectReference(in, "masked by neighbours", settings);
  EXPECT_LT(masked.summary.meanJnd, held.summary.meanJnd);
  settings = {};
  settings.temporal = SingleFrame{};
  in.predictedDisplacement = in.actualDisplacement;
  expectReference(in, "single frame", settings);
  const Upload upload(in);
  PoppingPredictorGpu predictor(context(), {200, 150}, studyDisplay(), {}, true);
  predictor.run(upload.input);
  const Image first = predictor.jnd().read();
  predictor.run(upload.input);
  EXPECT_EQ(predictor.jnd().read().data, first.data);
}

TEST_F(PoppingGpu, MovedDiscMatchesTheReference) {
  PoppingInput in = linearPair(sceneImage(200, 150, 0.45), sceneImage(200, 150, 0.452));
  EXPECT_GT(expectReference(in, "at rest").regions.regions.size(), 0U);
  in.linear = false;
  expectReference(in, "display-coded");
  in.actualDisplacement = noiseImage(200, 150, 2, 5, -4.0, 4.0);
  expectReference(in, "moving");
  in.predictedDisplacement = noiseImage(200, 150, 2, 6, -30.0, 30.0);
  in.disocclusion = noiseImage(200, 150, 1, 7);
  in.flicker = noiseImage(200, 150, 1, 8, 0.5, 1.5);
  expectReference(in, "moving apart, weighted");
  RecordProperty("largest_error", std::to_string(largest_));
}

TEST_F(PoppingGpu, NoiseAndOddSizesMatchTheReference) {
  const int sizes[][2] = {{129, 97}, {64, 64}, {33, 200}, {255, 5}, {96, 4}};
  for (const auto& size : sizes)
    expectReference(linearPair(noiseImage(size[0], size[1], 3, 1), noiseImage(size[0], size[1], 3, 2)),
                    std::to_string(size[0]) + " x " + std::to_string(size[1]));
}

TEST_F(PoppingGpu, HostileImagesMatchTheReference) {
  const int w = 65, h = 50;
  const Image black(w, h, 3), white(w, h, 3, 1.0F);
  Image dot = black, checker(w, h, 3), ramp(w, h, 3), bright = noiseImage(w, h, 3, 3, 0.0, 1.0);
  for (int c = 0; c < 3; ++c) dot.at(31, 20, c) = 1.0F;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      for (int c = 0; c < 3; ++c) {
        checker.at(x, y, c) = static_cast<float>((x + y) % 2);
        ramp.at(x, y, c) = static_cast<float>(x) / w;
      }
  for (size_t i = 0; i < bright.data.size(); i += 17) bright.data[i] = 5000.0F;
  expectReference(linearPair(black, white), "black and white");
  expectReference(linearPair(black, dot), "one pixel");
  expectReference(linearPair(white, checker), "checkerboard");
  expectReference(linearPair(checker, black), "checkerboard on black");
  expectReference(linearPair(ramp, white), "ramp");
  expectReference(linearPair(bright, ramp), "high dynamic range");
  DisplayProfile lightless = studyDisplay();
  lightless.blackCdM2 = 0.0;
  expectReference(linearPair(black, dot), "one pixel, no black level", {}, lightless);
  Image red(w, h, 3), yellow = noiseImage(w, h, 3, 9);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) red.at(x, y, 0) = x > 30 ? 1.0F : 0.5F, yellow.at(x, y, 2) = 0.0F;
  expectReference(linearPair(red, yellow), "saturated, no black level", {}, lightless);
}

TEST_F(PoppingGpu, SmallestImagesGiveNothing) {
  // Below 4 pixels there are not three Gaussian levels, hence no contrast.
  const int sizes[][2] = {{1, 1}, {1, 40}, {40, 1}, {3, 3}, {2, 7}};
  for (const auto& size : sizes) {
    const PoppingResult result = expectReference(
        linearPair(noiseImage(size[0], size[1], 3, 1), noiseImage(size[0], size[1], 3, 2)), "small");
    EXPECT_EQ(result.summary.largestJnd, 0.0);
  }
}

TEST_F(PoppingGpu, NonFiniteInputsAreFlushedAndCounted) {
  PoppingInput in = linearPair(sceneImage(64, 48, 0.4), sceneImage(64, 48, 0.45));
  in.actualDisplacement = noiseImage(64, 48, 2, 5, -4.0, 4.0);
  in.disocclusion = noiseImage(64, 48, 1, 7);
  const float kBad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                        -std::numeric_limits<float>::infinity()};
  for (size_t i = 0; i < in.actual.data.size(); i += 101) in.actual.data[i] = kBad[i % 3];
  for (size_t i = 0; i < in.actualDisplacement.data.size(); i += 103)
    in.actualDisplacement.data[i] = kBad[i % 3];
  for (size_t i = 0; i < in.disocclusion.data.size(); i += 107) in.disocclusion.data[i] = kBad[i % 3];
  EXPECT_GT(expectReference(in, "non-finite").flushedInputs, 0);
}

TEST_F(PoppingGpu, EqualFramesGiveExactlyZero) {
  PoppingInput in = linearPair(noiseImage(129, 97, 3, 1), noiseImage(129, 97, 3, 1));
  in.actualDisplacement = noiseImage(129, 97, 2, 5, -4.0, 4.0);
  const Run run = onGpu(in);
  EXPECT_EQ(*std::max_element(run.jnd.data.begin(), run.jnd.data.end()), 0.0F);
  EXPECT_TRUE(run.regions.regions.empty());
}

TEST_F(PoppingGpu, SwappingFramesLeavesTheMap) {
  const Image a = sceneImage(100, 80, 0.4), b = sceneImage(100, 80, 0.47);
  const Run forward = onGpu(linearPair(a, b)), backward = onGpu(linearPair(b, a));
  EXPECT_EQ(forward.jnd.data, backward.jnd.data);
  EXPECT_EQ(forward.regions.labels, backward.regions.labels);
}

TEST_F(PoppingGpu, RepeatsToTheByte) {
  const PoppingInput in = linearPair(noiseImage(200, 150, 3, 1), noiseImage(200, 150, 3, 2));
  const Upload upload(in);
  PoppingPredictorGpu predictor(context(), {200, 150}, studyDisplay());
  predictor.run(upload.input);
  const std::vector<float> first = predictor.jnd().read().data;
  const int64_t count = static_cast<int64_t>(predictor.readRegions().regions.size());
  ASSERT_GT(count, 0);
  const int64_t bytes = 16 + 64 * count;
  const std::vector<uint8_t> table = predictor.regionTable().read<uint8_t>(0, bytes);
  for (int i = 0; i < 3; ++i) {
    predictor.run(upload.input);
    EXPECT_EQ(predictor.jnd().read().data, first);
    EXPECT_EQ(predictor.regionTable().read<uint8_t>(0, bytes), table);
  }
}

TEST_F(PoppingGpu, EverySettingMatchesTheReference) {
  PoppingInput in = linearPair(sceneImage(72, 40, 0.45), sceneImage(72, 40, 0.5));
  in.actualDisplacement = noiseImage(72, 40, 2, 5, -4.0, 4.0);
  const auto with = [&](const std::map<std::string, ParameterValue>& given) {
    std::string what;
    for (const auto& [name, value] : given) what += name + "=" + toText(value) + " ";
    expectReference(
        in, what,
        PoppingSettings::table().read(ParameterValues(PoppingSettings::table().parameters(), given)));
  };
  with({});
  with({{"model", "schwarz_2009"}});
  with({{"bands.weights", "fitted"}, {"bands.levels.least_peak_cpd", 0.25}});
  with({{"bands.weights", "fitted"}, {"eye_movement", "none"}});
  for (const char* masking : {"none", "daly", "lubin", "self"}) with({{"masking", masking}});
  with({{"masking.b", 4.0}, {"masking.s", 0.5}});
  with({{"neighbourhood", "extended"}});
  with({{"model", "schwarz_2009"},
        {"neighbourhood", "extended"},
        {"neighbourhood.radius_px", int64_t{6}},
        {"neighbourhood.strength", 3.0},
        {"neighbourhood.dead_zone", 0.1}});
  with({{"masking", "self"},
        {"collapse", "magnitude"},
        {"neighbourhood", "extended"},
        {"neighbourhood.radius_px", int64_t{1}},
        {"neighbourhood.beta", 1.0}});
  with({{"model", "schwarz_2009"}, {"sensitivity.red_green.csf.reference_cd_m2", 20.0}});
  with({{"sensitivity.stimulus_area", "image"},
        {"sensitivity.achromatic.scale", "peak"},
        {"sensitivity.achromatic.csf", "castlecsf_transient"}});
  for (const char* eye : {"literal", "floor", "none"}) with({{"eye_movement", eye}});
  with({{"adaptation", "mean"}});
  with({{"adaptation", "fixed"}, {"adaptation.luminance_cd_m2", 20.0}});
  with({{"bands.decomposition.upsampler", "linear"}, {"bands.peak_model", "no_upsample"}});
  with({{"bands.peak_model", "halving"},
        {"bands.weights", "peak"},
        {"bands.weights.compensate_gain", false},
        {"sensitivity.contrast", "cones"},
        {"sensitivity.contrast.divide_grey_gain", false}});
  with({{"collapse", "magnitude"}, {"minkowski_exponent", 4.0}});
  with({{"regions.connectivity", int64_t{4}}, {"regions.threshold_jnd", 0.7}, {"regions.seeds", "none"}});
  with({{"bands.kernel_centre", 0.4}});
  with({{"bands.levels", "count"},
        {"bands.levels.gaussian", int64_t{4}},
        {"adaptation", "level"},
        {"adaptation.level", int64_t{1}}});
  with({{"sensitivity.achromatic.csf", "barten03"},
        {"sensitivity.red_green.csf", "martin92_rg"},
        {"sensitivity.blue_yellow.csf", "martin92_by"}});
}

TEST_F(PoppingGpu, StacksAreRefused) {
  PoppingSettings settings = PoppingSettings::preset(PredictorModel::Schwarz2009);
  settings.bands.decomposition = StackBands{};
  EXPECT_THROW(PoppingPredictorGpu(context(), {32, 32}, studyDisplay(), settings), Error);
}

TEST_F(PoppingGpu, EveryStageMatchesTheReference) {
  PoppingInput in = linearPair(sceneImage(96, 80, 0.45), sceneImage(96, 80, 0.5));
  in.actualDisplacement = noiseImage(96, 80, 2, 5, -4.0, 4.0);
  in.disocclusion = noiseImage(96, 80, 1, 7);
  PoppingOptions options;
  options.stages = {"all"};
  PoppingSettings byNeighbours;
  byNeighbours.neighbourhood = ExtendedMasking{};
  for (const PoppingSettings& settings : {PoppingSettings{}, byNeighbours})
    for (const bool isSwitch : {false, true}) {
      in.isSwitch = isSwitch;
      const PoppingResult reference = predictPopping(in, studyDisplay(), settings, options);
      const Upload upload(in);
      PoppingPredictorGpu predictor(context(), {96, 80}, studyDisplay(), settings, isSwitch);
      predictor.run(upload.input);
      const std::vector<std::string> stages = poppingStages(predictor.model());
      EXPECT_EQ(stages.size(), reference.stages.size());
      for (const std::string& name : stages) {
        const Image& expected = reference.stages.at(name);
        const Image got = predictor.debugImage(name, upload.input);
        ASSERT_EQ(got.data.size(), expected.data.size()) << name;
        // Positive and negative powers cancel before the root is taken, so it is the sum whose error is
        // small.
        const auto valueOf = [&](float value) {
          const double exponent = name == "signed_jnd" ? settings.minkowskiExponent : 1.0;
          return std::copysign(std::pow(std::abs(double{value}), exponent), value);
        };
        double largest = 0.0, worst = 0.0;
        for (size_t i = 0; i < got.data.size(); ++i) {
          largest = std::max(largest, std::abs(valueOf(expected.data[i])));
          worst = std::max(worst, std::abs(valueOf(got.data[i]) - valueOf(expected.data[i])));
        }
        EXPECT_LE(worst, 1e-3 * largest) << name << (isSwitch ? " of a switch" : "");
      }
      EXPECT_THROW(predictor.debugImage("lms", upload.input), Error);
      EXPECT_EQ(predictor.readCounts().guardedContrasts, 0U);
    }
}

// Shapes that union-find by tiles of 32 may get wrong: combs, spirals, a diagonal through tiles' corners, a
// full image, isolated pixels, noise of every density.
TEST_F(PoppingGpu, RegionsMatchFloodFill) {
  const int w = 150, h = 101;
  std::vector<std::vector<double>> maps;
  const auto make = [&](const auto& on) {
    std::vector<double> map(static_cast<size_t>(w) * h, 0.5);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x)
        if (on(x, y)) map[static_cast<size_t>(y) * w + x] = 2.0 + 0.01 * ((x * 7 + y * 3) % 100);
    maps.push_back(map);
  };
  make([](int, int) { return true; });
  make([](int, int) { return false; });
  make([](int x, int y) { return x == y; });
  make([](int x, int y) { return x % 2 == 0 && y % 2 == 0; });
  make([](int x, int y) { return (x + y) % 2 == 0; });
  make([](int x, int y) { return y == 100 || x % 2 == 0; });
  make([](int x, int y) { return x == 0 || y % 2 == 0; });
  make([](int x, int y) { return y % 4 == 0 || (y % 4 == 2 && false) || x == (y / 4 % 2 ? 149 : 0); });
  make([](int x, int y) { return std::max(std::abs(x - 75), std::abs(y - 50)) % 3 == 0; });
  make([](int x, int y) { return (x == 31 || x == 32) && (y == 31 || y == 32); });
  make([](int x, int y) { return (x == 32 && y == 31) || (x == 31 && y == 32); });
  for (const double density : {0.1, 0.3, 0.41, 0.5, 0.6, 0.8, 0.95}) {
    const Image noise = noiseImage(w, h, 1, static_cast<unsigned>(100 * density));
    make([&](int x, int y) { return noise.at(x, y) < density; });
  }
  const Image seedNoise = noiseImage(w, h, 1, 77);
  for (const int connectivity : {8, 4}) {
    PoppingSettings settings;
    settings.regions.connectivity = connectivity;
    RegionsGpu gpu(context(), {w, h}, settings);
    for (size_t i = 0; i < maps.size(); ++i)
      for (const double seedShare : {1.1, 0.02}) {
        SCOPED_TRACE(std::to_string(i) + " seeds " + std::to_string(seedShare));
        std::vector<uint8_t> seeds(maps[i].size());
        std::vector<uint8_t> seedBytes;
        for (size_t p = 0; p < seeds.size(); ++p) seeds[p] = seedNoise.data[p] < seedShare ? 1 : 0;
        Image jnd(w, h, 1);
        std::vector<double> rounded(maps[i].size());
        for (size_t p = 0; p < seeds.size(); ++p)
          jnd.data[p] = static_cast<float>(maps[i][p]), rounded[p] = double{jnd.data[p]};
        Texture jndTexture(Format::R32F, {w, h}), seedTexture(Format::R8UI, {w, h});
        jndTexture.write(jnd);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTextureSubImage2D(seedTexture.id(), 0, 0, 0, w, h, GL_RED_INTEGER, GL_UNSIGNED_BYTE, seeds.data());
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        gpu.run(jndTexture, seedTexture);
        expectSameRegions(gpu.read(), findRegions(rounded, seeds, w, h, settings), 1e-5);
      }
  }
}

/// Two planes at depths 1 and 2 that meet along a slanted line, shifted.
Image stepDepth(int w, int h, double shift) {
  Image depth(w, h, 1);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      depth.at(x, y) = x + 0.3 * y + shift < 0.5 * w ? 1.0F : x > w - 6 ? 0.0F : 2.0F;
  return depth;
}

TEST_F(PoppingGpu, WeightsMatchTheReference) {
  const int w = 90, h = 61;
  std::vector<DisocclusionView> views(2);
  for (int i = 0; i < 2; ++i) {
    views[i].previousDepth = stepDepth(w, h, 2.0 * i);
    views[i].previousDepthOfPixel = stepDepth(w, h, 5.0);
    views[i].displacement = noiseImage(w, h, 2, 4, -7.0, 7.0);
  }
  PoppingSettings settings;
  for (const int radius : {0, 1}) {
    const DisocclusionSettings weight{.outsideVisibility = 0.25 * radius, .pcfRadiusPx = radius};
    settings.disocclusion = weight;
    const Image expected = disocclusionWeight(views, weight);
    std::vector<Texture> textures;
    for (const DisocclusionView& view : views) {
      textures.push_back(Upload::upload(view.previousDepthOfPixel, 1));
      textures.push_back(Upload::upload(view.displacement, 2));
      textures.push_back(Upload::upload(view.previousDepth, 1));
    }
    const Texture target(Format::R32F, {w, h});
    PoppingWeightsGpu weights(context(), settings);
    weights.disocclusion(
        {{&textures[0], &textures[1], &textures[2]}, {&textures[3], &textures[4], &textures[5]}}, target);
    const Image got = target.read();
    for (size_t p = 0; p < got.data.size(); ++p) ASSERT_NEAR(got.data[p], expected.data[p], 1e-5) << p;
  }

  FlickerInput input;
  input.actual = sceneImage(w, h, 0.4);
  input.predicted = noiseImage(w, h, 3, 6, 0.3, 0.5);
  input.previousShading = noiseImage(w, h, 3, 1, 0.3, 0.5);
  input.previousFrame = noiseImage(w, h, 3, 2, 0.3, 0.5);
  input.displacement = noiseImage(w, h, 2, 3, -9.0, 9.0);
  input.previousDepthOfPixel = stepDepth(w, h, 1.0);
  input.previousDepth = stepDepth(w, h, 0.0);
  const Texture colours[] = {Upload::upload(input.actual, 4), Upload::upload(input.predicted, 4),
                             Upload::upload(input.previousShading, 4),
                             Upload::upload(input.previousFrame, 4)};
  const Texture move = Upload::upload(input.displacement, 2), target(Format::R32F, {w, h});
  const Texture depths[] = {Upload::upload(input.previousDepthOfPixel, 1),
                            Upload::upload(input.previousDepth, 1)};
  PoppingWeightsGpu weights(context(), settings);
  for (const bool compareDepth : {true, false}) {
    if (!compareDepth) input.previousDepth = input.previousDepthOfPixel = {};
    const Image expected = flickerWeight(input, settings.flickerSettings());
    weights.flicker({&colours[0], &colours[1], &colours[2], &colours[3], &move,
                     compareDepth ? &depths[0] : nullptr, compareDepth ? &depths[1] : nullptr},
                    target);
    const Image got = target.read();
    int64_t other = 0, flickering = 0;
    for (size_t p = 0; p < got.data.size(); ++p) {
      other += got.data[p] != expected.data[p];
      flickering += expected.data[p] < 1.0F;
    }
    // Only where both differences agree to single precision may the verdicts part: one pixel in 5490 would be
    // bad luck already.
    EXPECT_LE(other, 1);
    EXPECT_GT(flickering, 200);
  }
}

}  // namespace
}  // namespace limen::perception
