// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "perception/popping/popping_gpu.h"
#include "tests/perception/popping_images.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::perception {

/// Textures of an input.
struct PoppingUpload {
  std::optional<gl::Texture> textures[6];
  PoppingGpuInput input;

  static gl::Texture upload(const Image& image, int channels) {
    Image padded(image.width, image.height, channels, 1.0F);
    for (size_t p = 0; p < image.pixels(); ++p)
      for (int c = 0; c < std::min(channels, image.channels); ++c)
        padded.data[p * static_cast<size_t>(channels) + static_cast<size_t>(c)] =
            image.data[p * static_cast<size_t>(image.channels) + static_cast<size_t>(c)];
    gl::Texture texture(channels == 1   ? gl::Format::R32F
                        : channels == 2 ? gl::Format::RG32F
                                        : gl::Format::RGBA32F,
                        {image.width, image.height});
    texture.write(padded);
    return texture;
  }

  explicit PoppingUpload(const PoppingInput& in) {
    const Image* images[6] = {
        &in.actual,       &in.predicted, &in.actualDisplacement, &in.predictedDisplacement,
        &in.disocclusion, &in.flicker};
    const int channels[6] = {in.actual.channels < 3 ? 1 : 4, in.actual.channels < 3 ? 1 : 4, 2, 2, 1, 1};
    const gl::Texture** slots[6] = {
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

/// Runs the predictor on the GPU and holds it to the reference.
class PoppingGpu : public gl::GlTest {
 protected:
  struct Run {
    Image jnd;
    RegionMap regions;
    PoppingPredictorGpu::Counts counts;
  };
  static Run onGpu(const PoppingInput& in, const PoppingSettings& settings = {},
                   const DisplayProfile& display = studyDisplay()) {
    const PoppingUpload upload(in);
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

}  // namespace limen::perception
