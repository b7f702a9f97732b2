// SPDX-License-Identifier: BSD-3-Clause
#include "perception/band_thresholds/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/base/error.h"
#include "perception/multiscale/pyramid.h"
#include "perception/popping/predictor.h"
#include "perception/threshold_maps/reference.h"
#include "tests/perception/band_thresholds/natural_images.h"

namespace limen::perception {
namespace {

constexpr int kWidth = 96, kHeight = 72;

DisplayProfile display() { return displayPreset("schwarz_2009"); }

Plane image(int index) {
  return naturalImage(index, kWidth, kHeight, display().blackLevelCdM2(), display().whiteLevelCdM2());
}

/// What the predictor says of a picture and the same with `difference` added.
struct Judged {
  double pooled = 0.0;        ///< largest JND
  std::vector<double> bands;  ///< largest of each band's response differences in channel A
  double band() const { return *std::max_element(bands.begin(), bands.end()); }
};

Image shown(const Plane& luminance) {
  const double black = display().blackLevelCdM2(), range = display().whiteLevelCdM2() - black;
  Image out(luminance.width, luminance.height, 1);
  for (size_t i = 0; i < luminance.data.size(); ++i)
    out.data[i] = static_cast<float>((luminance.data[i] - black) / range);
  return out;
}

Judged judge(const Plane& luminance, const Plane& difference, double scale,
             const PoppingSettings& settings = {}) {
  Plane changed = luminance;
  for (size_t i = 0; i < changed.data.size(); ++i) changed.data[i] += scale * difference.data[i];
  PoppingInput input;
  input.actual = shown(changed);
  input.predicted = shown(luminance);
  input.linear = true;
  const PoppingModel model = poppingModel(luminance.width, luminance.height, display(), settings);
  PoppingOptions options;
  for (int i = 0; i < model.contrastLevels; ++i) options.stages.push_back("difference_" + std::to_string(i));
  const PoppingResult result = predictPopping(input, display(), settings, options);
  Judged out{result.summary.largestJnd, {}};
  for (const std::string& stage : options.stages) {
    const Image& band = result.stages.at(stage);
    double largest = 0.0;
    for (size_t i = 0; i < band.data.size(); i += 3)
      largest = std::max(largest, std::abs(double{band.data[i]}));
    out.bands.push_back(largest);
  }
  return out;
}

Plane grating(double cyclesPerPx, bool upright, double phase) {
  Plane out(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      out.at(x, y) = std::sin(2.0 * std::numbers::pi * cyclesPerPx * (upright ? x : y) + phase);
  return out;
}

/// Band `band` alone of an image, at full size.
Plane bandOf(const Plane& source, int band) {
  const PyramidSettings pyramid{band + 2, Kernel::binomial5(), Upsampler::Expand, Border::Clamp};
  std::vector<Plane> levels = laplacianPyramid(gaussianPyramid(source, pyramid), pyramid);
  for (int i = 0; i <= band + 1; ++i)
    if (i != band)
      std::fill(levels[static_cast<size_t>(i)].data.begin(), levels[static_cast<size_t>(i)].data.end(), 0.0);
  return collapse(levels, pyramid);
}

Plane noiseBand(int band, unsigned seed) {
  std::mt19937 random(seed);
  Plane noise(kWidth, kHeight);
  for (double& value : noise.data) value = 2.0 * uniform(random) - 1.0;
  Plane out = bandOf(noise, band);
  double largest = 0.0;
  for (const double value : out.data) largest = std::max(largest, std::abs(value));
  for (double& value : out.data) value /= largest;
  return out;
}

/// `shape`, at most 1 in magnitude, scaled at each pixel to what a map allows.
Plane underMap(const Plane& shape, const Plane& map) {
  Plane out = shape;
  for (size_t i = 0; i < out.data.size(); ++i) out.data[i] *= map.data[i];
  return out;
}

/// A difference, cut at what a map allows.
Plane cutAtMap(const Plane& difference, const Plane& map) {
  Plane out = difference;
  for (size_t i = 0; i < out.data.size(); ++i)
    out.data[i] = std::clamp(out.data[i], -map.data[i], map.data[i]);
  return out;
}

/// Differences of every band that a map of `luminance` is tried with, as large as the map allows.
std::vector<std::pair<std::string, Plane>> differencesUnder(const Plane& map, const Plane& luminance,
                                                            int index) {
  std::vector<std::pair<std::string, Plane>> out;
  const PoppingModel model = poppingModel(kWidth, kHeight, display(), {});
  for (int band = 0; band < model.contrastLevels; ++band) {
    const std::string name = " of band " + std::to_string(band);
    const double cyclesPerPx = model.peakCpd[static_cast<size_t>(band)] / model.pixelsPerDegree;
    out.emplace_back(
        "grating" + name,
        underMap(grating(std::min(cyclesPerPx, 0.45), (index + band) % 2 != 0, 0.7 * index), map));
    out.emplace_back("noise" + name,
                     underMap(noiseBand(band, static_cast<unsigned>(31 * index + band)), map));
    Plane blur = bandOf(luminance, band);
    for (double& value : blur.data) value = -value;
    out.emplace_back("blur" + name, cutAtMap(blur, map));
  }
  return out;
}

TEST(BandThresholds, CombinedMapHolds) {
  // Nothing below nine tenths of it changes a band's response by 1 JND, nor all of them together.
  double largestBand = 0.0, largestPooled = 0.0;
  for (int index = 0; index < kNaturalImages; ++index) {
    const Plane luminance = image(index);
    const BandThresholds thresholds = computeBandThresholds(luminance, display(), {});
    for (const auto& [name, difference] : differencesUnder(thresholds.combinedCdM2, luminance, index)) {
      const Judged judged = judge(luminance, difference, 0.9);
      EXPECT_LT(judged.band(), 1.0) << "image " << index << ", " << name;
      EXPECT_LT(judged.pooled, 1.0) << "image " << index << ", " << name;
      largestBand = std::max(largestBand, judged.band());
      largestPooled = std::max(largestPooled, judged.pooled);
      if (getenv("LIMEN_SHOW"))
        printf("%d %s band %.3f pooled %.3f\n", index, name.c_str(), judged.band(), judged.pooled);
    }
  }
  // Nor is it safe by being close to nothing.
  EXPECT_GT(largestPooled, 0.5);
}

TEST(BandThresholds, BandsInvertThePredictor) {
  for (int index = 0; index < kNaturalImages; ++index) {
    const Plane luminance = image(index);
    const BandThresholds thresholds = computeBandThresholds(luminance, display(), {});
    // Every other band, in turn.
    for (int band = index % 2; band < static_cast<int>(thresholds.bands.size()); band += 2) {
      const Plane difference = noiseBand(band, static_cast<unsigned>(index + 100 * band));
      const BandRatios ratios = compareWithThresholds(difference, thresholds, {});
      double largest = 0.0, pooled = 0.0;
      for (const Plane& plane : ratios.ratios)
        for (const double value : plane.data) largest = std::max(largest, std::abs(value));
      for (const double value : ratios.pooled.data) pooled = std::max(pooled, value);
      // Thresholds are those of the direction in which less is needed.
      const Judged up = judge(luminance, difference, 0.9 / largest),
                   down = judge(luminance, difference, -0.9 / largest);
      EXPECT_LT(std::max(up.band(), down.band()), 1.0) << index << ' ' << band;
      EXPECT_GT(std::max(up.band(), down.band()), 0.8) << index << ' ' << band;
      EXPECT_LT(judge(luminance, difference, 0.9 / pooled).pooled, 1.0) << index << ' ' << band;
      if (getenv("LIMEN_SHOW")) printf("%d band %d: %.3f %.3f\n", index, band, up.band(), down.band());
    }
  }
}

TEST(BandThresholds, TheSingleMapOfTheThesisDoesNotHold) {
  // It lends one band's masking to all frequencies.
  double largest = 0.0;
  int above = 0, tried = 0;
  for (int index = 0; index < kNaturalImages; index += 4) {
    const Plane luminance = image(index);
    const ThresholdMap map = computeThresholdMap(luminance, display().pixelsPerDegree(), {});
    for (const auto& [name, difference] : differencesUnder(map.thresholdCdM2, luminance, index)) {
      const double pooled = judge(luminance, difference, 0.9).pooled;
      largest = std::max(largest, pooled);
      ++tried;
      above += pooled > 1.0 ? 1 : 0;
    }
  }
  if (getenv("LIMEN_SHOW")) printf("single: largest %.2f, %d of %d above\n", largest, above, tried);
  EXPECT_GT(largest, 3.0);
}

TEST(BandThresholds, RefusesWhatHasNoInverse) {
  const auto refused = [](const PoppingSettings& predictor) {
    BandThresholdSettings settings;
    settings.predictor = predictor;
    try {
      BandThresholdModel(settings, display(), kWidth, kHeight);
    } catch (const Error&) {
      return true;
    }
    return false;
  };
  PoppingSettings predictor;
  EXPECT_FALSE(refused(predictor));
  predictor.bands.weights = FittedWeights{};
  EXPECT_TRUE(refused(predictor));
  predictor = {};
  predictor.neighbourhood = ExtendedMasking{};
  EXPECT_TRUE(refused(predictor));
}

}  // namespace
}  // namespace limen::perception
