// SPDX-License-Identifier: BSD-3-Clause
// ColorVideoVDP on the GPU against the authors' scores and against the version in double precision.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "experiments/base/error.h"
#include "perception/metrics/color_video_vdp/color_video_vdp_gpu.h"
#include "perception/metrics/color_video_vdp/reference.h"
#include "perception/metrics/metric.h"
#include "perception/metrics/metric_gpu.h"
#include "vectors.h"

namespace limen::perception::cvvdp {
namespace {

gl::Context& context() {
  static const std::unique_ptr<gl::Context> kContext = gl::createHeadlessContext();
  return *kContext;
}

class CvvdpGpuVectors : public testing::TestWithParam<std::string> {};

// Their own single precision is off by up to 1e-5 JOD on a GPU; ten times that is what the last digits of
// another order of sums may cost.
TEST_P(CvvdpGpuVectors, ScoreIsTheAuthors) {
  const Vector& v = vectorOf(GetParam());
  EXPECT_NEAR(evaluateOnGpu(context(), v.pair(), v.options).jod, v.jod, 1e-4);
  context().checkDebugMessages();
}

INSTANTIATE_TEST_SUITE_P(All, CvvdpGpuVectors, testing::ValuesIn(vectorIds()),
                         [](const testing::TestParamInfo<std::string>& id) { return id.param; });

/// Smooth colour texture that moves, with a disturbance of its own in the test.
Image movingFrame(int width, int height, int frame, double disturbance) {
  Image out(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        out.at(x, y, c) =
            static_cast<float>(0.45 + 0.3 * std::sin(0.21 * x + 0.13 * y + 0.4 * frame + c) +
                               disturbance * std::sin(0.9 * x - 1.3 * y + 2.1 * frame + 0.3 * c));
  return out;
}

Pair movingPair(int width, int height, int frames, double disturbance) {
  return {width, height, frames, [=](int frame) { return movingFrame(width, height, frame, disturbance); },
          [=](int frame) { return movingFrame(width, height, frame, 0.0); }};
}

Options optionsOf(const std::string& display, double framesPerSecond = 0.0) {
  Options out;
  out.display = readDisplay(display);
  out.framesPerSecond = framesPerSecond;
  return out;
}

TEST(CvvdpGpu, EqualPairsGiveExactlyTen) {
  EXPECT_EQ(evaluateOnGpu(context(), movingPair(61, 44, 1, 0.0), optionsOf("standard_4k")).jod, 10.0);
  EXPECT_EQ(evaluateOnGpu(context(), movingPair(61, 44, 12, 0.0), optionsOf("standard_fhd", 30.0)).jod, 10.0);
}

// Scores, and the differences of every frame, channel and band, against double precision: sizes of mixed
// parity and down to the least, all paddings and borders.
TEST(CvvdpGpu, AgreesWithDoublePrecision) {
  struct Case {
    int width, height, frames;
    double framesPerSecond;
    TemporalPadding padding;
    bool referenceBorders;
    const char* display;
  };
  constexpr auto kReplicate = TemporalPadding::Replicate, kSymmetric = TemporalPadding::Symmetric;
  for (const Case& c :
       {Case{4, 4, 1, 0, kReplicate, true, "standard_4k"}, Case{7, 5, 1, 0, kReplicate, true, "standard_hmd"},
        Case{64, 33, 1, 0, kReplicate, false, "htc_vive_pro"},
        Case{33, 64, 1, 0, kReplicate, true, "iphone_14_pro"},
        Case{37, 52, 3, 24, kSymmetric, true, "standard_fhd"},
        Case{52, 37, 21, 30, kSymmetric, true, "standard_phone"},
        Case{48, 40, 25, 30, kReplicate, false, "standard_4k"}}) {
    Options options = optionsOf(c.display, c.framesPerSecond);
    options.padding = c.padding;
    options.referenceBorders = c.referenceBorders;
    const Pair pair = movingPair(c.width, c.height, c.frames, 0.05);
    const Score expected = evaluate(pair, options).score;
    const Score actual = evaluateOnGpu(context(), pair, options);
    EXPECT_NEAR(actual.jod, expected.jod, 1e-4) << c.width << " x " << c.height;
    ASSERT_EQ(actual.frames.size(), expected.frames.size());
    for (size_t frame = 0; frame < actual.frames.size(); ++frame)
      for (size_t band = 0; band < actual.frames[frame].size(); ++band)
        for (size_t channel = 0; channel < kChannels; ++channel) {
          const double q = expected.frames[frame][band][channel];
          // Small ones are offset powers of what single precision leaves of differences; they do not count.
          EXPECT_NEAR(actual.frames[frame][band][channel], q, 1e-4 * q + 3e-5)
              << c.width << " x " << c.height << " " << frame << " " << band << " " << channel;
        }
  }
}

TEST(CvvdpGpu, MapsAgreeWithDoublePrecision) {
  for (const int frames : {1, 4}) {
    Options options = optionsOf("standard_fhd", 24.0);
    options.map = true;
    const Pair pair = movingPair(75, 50, frames, 0.06);
    const std::vector<Plane> expected = evaluate(pair, options).maps;
    size_t visited = 0;
    evaluateOnGpu(context(), pair, options, [&](int frame, const Image& map) {
      ++visited;
      for (size_t i = 0; i < map.data.size(); ++i)
        ASSERT_NEAR(map.data[i], expected[static_cast<size_t>(frame)].data[i], 1e-4) << frame << " " << i;
    });
    EXPECT_EQ(visited, expected.size());
  }
}

// A product as light gives what its code for the display gives.
TEST(CvvdpGpu, LightEqualsCode) {
  const Pair coded = movingPair(40, 30, 1, 0.05);
  const auto light = [](Image image) {
    for (float& v : image.data)
      v = static_cast<float>(v > 0.04045 ? std::pow((v + 0.055) / 1.055, 2.4) : v / 12.92);
    return image;
  };
  Options options = optionsOf("standard_4k");
  const double expected = evaluateOnGpu(context(), coded, options).jod;
  options.values = Values::Relative;
  const Pair linear = {40, 30, 1, [&](int frame) { return light(coded.test(frame)); },
                       [&](int frame) { return light(coded.reference(frame)); }};
  EXPECT_NEAR(evaluateOnGpu(context(), linear, options).jod, expected, 1e-4);
}

/// Scores of a clip whose defect grows with its strength, 0 to 4.
std::vector<double> scoresOf(const std::function<double(int x, int y, int frame, int strength)>& value) {
  constexpr int kFrames = 18;
  std::vector<double> out;
  const auto source = [&](int strength) {
    return [&value, strength](int frame) {
      Image image(64, 48, 1);
      for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
          image.at(x, y) = static_cast<float>(value(x, y, frame, strength));
      return image;
    };
  };
  const Options options = optionsOf("standard_fhd", 30.0);
  for (int strength = 0; strength <= 4; ++strength)
    out.push_back(evaluateOnGpu(context(), {64, 48, kFrames, source(strength), source(0)}, options).jod);
  return out;
}

void expectFalling(const std::vector<double>& scores) {
  EXPECT_EQ(scores.front(), 10.0);
  for (size_t i = 1; i < scores.size(); ++i) EXPECT_LT(scores[i], scores[i - 1] - 0.01) << i;
}

/// Edges and waves, moving to the right by a pixel a frame.
double movingPattern(double x, int y) {
  return 0.5 + (std::sin(0.39 * x) > 0.0 ? 0.15 : -0.15) + 0.1 * std::sin(0.7 * y + 0.2 * x);
}

TEST(CvvdpClips, ScoreFallsWithGrowingFlicker) {
  expectFalling(scoresOf([](int x, int y, int frame, int strength) {
    const double patch = x > 20 && x < 44 && y > 14 && y < 34 ? 1.0 : 0.0;
    return movingPattern(x, y) + 0.02 * strength * patch * (frame / 2 % 2 ? 1.0 : -1.0);
  }));
}

TEST(CvvdpClips, ScoreFallsWithGrowingBlur) {
  expectFalling(scoresOf([](int x, int y, int frame, int strength) {
    double sum = 0.0;  // box of growing width along the motion
    for (int i = -strength; i <= strength; ++i) sum += movingPattern(x - frame + i, y);
    return sum / (2 * strength + 1);
  }));
}

TEST(CvvdpClips, ScoreFallsWithGrowingJudder) {
  expectFalling(scoresOf([](int x, int y, int frame, int strength) {
    const int held = frame / (strength + 1) * (strength + 1);  // each picture shown 1 to 5 times
    return movingPattern(x - held, y);
  }));
}

TEST(CvvdpMetric, EvaluatesProductsAsImagesOfLight) {
  MetricGpu gpu(context());
  const MetricInfo& info = MetricRegistry::instance().get("color_video_vdp");
  const Image test = movingFrame(37, 30, 0, 0.05), reference = movingFrame(37, 30, 0, 0.0);
  ComparisonInput input;
  input.test = &test, input.reference = &reference, input.gpu = &gpu;
  Options options = optionsOf("standard_4k");
  options.values = Values::Relative;
  options.map = true;
  const Pair pair = {37, 30, 1, [&](int) { return test; }, [&](int) { return reference; }};
  for (const char* display : {"standard_4k", "desktop_24"}) {
    options.display = readDisplay(display);
    const ReferenceResult expected = evaluate(pair, options);
    const MetricResult found = info.compare(input, {info.parameters, {{"display", std::string(display)}}});
    EXPECT_NEAR(found.value, expected.score.jod, 1e-4) << display;
    ASSERT_TRUE(found.map);
    for (size_t i = 0; i < found.map->data.size(); ++i)
      ASSERT_NEAR(found.map->data[i], expected.maps[0].data[i], 1e-4) << i;
  }
  input.gpu = nullptr;
  EXPECT_THROW(info.compare(input, {info.parameters, {}}), Error);
}

}  // namespace
}  // namespace limen::perception::cvvdp
