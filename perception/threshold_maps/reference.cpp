// SPDX-License-Identifier: BSD-3-Clause
#include "perception/threshold_maps/reference.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>

#include "perception/threshold_maps/model.h"

namespace limen::perception {
namespace {

std::vector<Plane> levelsOf(const Plane& image, const ThresholdMapSettings& settings) {
  PyramidSettings pyramid = settings.pyramid();
  if (settings.isTrueStack()) return gaussianStack(image, pyramid, settings.stackSigmaPx());
  if (std::holds_alternative<RepeatedStack>(settings.decomposition)) {
    pyramid.kernel = Kernel::binomial5();
    return repeatedStack(image, pyramid);
  }
  return upsampledStack(gaussianPyramid(image, pyramid), pyramid);
}

/// Section 9.6: of an image 2 tan(fov / 2) / 0.01745 pixels wide each pixel would cover a degree; that
/// number, taken for the side of the averaging kernel.
std::optional<Plane> mistakenMean(const Plane& image, double pixelsPerDegree,
                                  const ThresholdMapSettings& settings) {
  if (!std::holds_alternative<MistakenDegreeAdaptation>(settings.adaptation)) return {};
  // The field of view whose centre has these pixels per degree: W = 2 tan(fov / 2) ppd / tan(1 degree).
  const double side = std::tan(std::numbers::pi / 180.0) * image.width / pixelsPerDegree / 0.01745;
  const int sidePx = std::clamp(static_cast<int>(std::lround(side)), 1, 4096);
  return resample(image, boxTaps(image.width, sidePx, settings.border),
                  boxTaps(image.height, sidePx, settings.border));
}

}  // namespace

ThresholdMap computeThresholdMap(const Plane& luminanceCdM2, double pixelsPerDegree,
                                 const ThresholdMapSettings& settings) {
  const int width = luminanceCdM2.width, height = luminanceCdM2.height;
  const ThresholdModel model(settings, pixelsPerDegree, width, height);
  const Plane image = finiteNonNegative(luminanceCdM2, settings.largestCdM2);

  ThresholdMap map;
  map.levels = levelsOf(image, settings);
  ContrastLevels contrast = contrastStack(map.levels, settings.contrastEpsilonCdM2);
  map.contrasts = std::move(contrast.levels);
  map.guarded = contrast.guarded;
  for (Plane& plane : map.contrasts)
    for (double& value : plane.data) value = std::abs(value);

  map.thresholdCdM2 = map.adaptationCdM2 = map.elevation = Plane(width, height);
  const AdaptationBlend& blend = model.adaptation();
  const Plane& near = map.levels[static_cast<size_t>(blend.level)];
  const Plane& far = map.levels[std::min(static_cast<size_t>(blend.level) + 1, map.levels.size() - 1)];
  const std::optional<Plane> mistaken = mistakenMean(image, pixelsPerDegree, settings);
  forRowBlocks(height, static_cast<size_t>(width) * 400, [&](int first, int end) {
    std::vector<double> contrasts(map.contrasts.size());
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        const double adaptation =
            mistaken ? mistaken->at(x, y) : (1.0 - blend.next) * near.at(x, y) + blend.next * far.at(x, y);
        for (size_t band = 0; band < contrasts.size(); ++band) contrasts[band] = map.contrasts[band].at(x, y);
        const double elevation = model.elevation(contrasts, adaptation);
        map.adaptationCdM2.at(x, y) = adaptation;
        map.elevation.at(x, y) = elevation;
        map.thresholdCdM2.at(x, y) = model.thresholdCdM2(elevation, adaptation);
      }
  });
  return map;
}

Plane luminancePlane(const Image& linear, const DisplayProfile& display) {
  Plane out(linear.width, linear.height);
  const auto channels = static_cast<size_t>(linear.channels);
  assert(channels != 2);
  for (size_t i = 0; i < out.data.size(); ++i) {
    const float* pixel = linear.data.data() + i * channels;
    out.data[i] = channels == 1
                      ? double{pixel[0]}
                      : display.luminanceCdM2({double{pixel[0]}, double{pixel[1]}, double{pixel[2]}});
  }
  return out;
}

Image toImage(const Plane& plane) {
  Image out(plane.width, plane.height, 1);
  for (size_t i = 0; i < plane.data.size(); ++i) out.data[i] = static_cast<float>(plane.data[i]);
  return out;
}

double decisionFlips(const Plane& thresholdA, const Plane& thresholdB, const Plane& differenceCdM2) {
  assert(thresholdA.data.size() == thresholdB.data.size() &&
         thresholdA.data.size() == differenceCdM2.data.size());
  size_t flips = 0;
  for (size_t i = 0; i < differenceCdM2.data.size(); ++i) {
    const double difference = std::abs(differenceCdM2.data[i]);
    flips += (difference > thresholdA.data[i]) != (difference > thresholdB.data[i]) ? 1 : 0;
  }
  return differenceCdM2.data.empty()
             ? 0.0
             : static_cast<double>(flips) / static_cast<double>(differenceCdM2.data.size());
}

}  // namespace limen::perception
