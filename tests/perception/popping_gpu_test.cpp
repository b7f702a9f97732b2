// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <map>

#include "experiments/base/error.h"
#include "tests/perception/popping_gpu_fixture.h"

namespace limen::perception {
namespace {

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
  const PoppingUpload upload(in);
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
  const PoppingUpload upload(in);
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
      const PoppingUpload upload(in);
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

}  // namespace
}  // namespace limen::perception
