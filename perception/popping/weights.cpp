// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/weights.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "perception/metrics/row_sums.h"
#include "perception/vision/colour.h"

namespace limen::perception {
namespace {

double finite(double value) { return std::isfinite(value) ? value : 0.0; }

/// Previous position of a pixel's centre, in pixels; (0.5, 0.5) is the first pixel's centre.
glm::dvec2 previousPlace(const Image& displacement, int x, int y) {
  return glm::dvec2(x + 0.5, y + 0.5) -
         glm::dvec2(finite(displacement.at(x, y, 0)), finite(displacement.at(x, y, 1)));
}

bool inside(glm::dvec2 place, const Image& image) {
  return place.x >= 0.0 && place.y >= 0.0 && place.x <= image.width && place.y <= image.height;
}

/// 1 where a point of `pointDepth` is not hidden behind `mapDepth`. Background (<= 0) is infinitely far.
bool seen(double pointDepth, double mapDepth, double tolerance) {
  if (!(mapDepth > 0.0)) return true;
  if (!(pointDepth > 0.0)) return false;
  return pointDepth <= mapDepth * (1.0 + tolerance);
}

/// Calls use(x, y, weight) for the four texels around a position, clamped to the image.
template <class Use>
void forBilinear(glm::dvec2 place, int width, int height, const Use& use) {
  const double x = place.x - 0.5, y = place.y - 0.5;
  const double left = std::floor(x), top = std::floor(y);
  const double fx = x - left, fy = y - top;
  const auto clampTo = [](double value, int size) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size - 1)));
  };
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i)
      use(clampTo(left + i, width), clampTo(top + j, height), (i ? fx : 1.0 - fx) * (j ? fy : 1.0 - fy));
}

double visibility(const DisocclusionView& view, int x, int y, const DisocclusionSettings& settings) {
  const glm::dvec2 place = previousPlace(view.displacement, x, y);
  if (!inside(place, view.previousDepth)) return settings.outsideVisibility;
  const double depth = view.previousDepthOfPixel.at(x, y);
  double sum = 0.0;
  int taps = 0;
  for (int j = -settings.pcfRadiusPx; j <= settings.pcfRadiusPx; ++j)
    for (int i = -settings.pcfRadiusPx; i <= settings.pcfRadiusPx; ++i, ++taps)
      forBilinear(place + glm::dvec2(i, j), view.previousDepth.width, view.previousDepth.height,
                  [&](int px, int py, double weight) {
                    if (seen(depth, view.previousDepth.at(px, py), settings.depthTolerance)) sum += weight;
                  });
  return std::clamp(sum / taps, 0.0, 1.0);
}

Lab labAt(const Image& image, int x, int y) {
  std::array<double, 3> rgb{};
  for (int c = 0; c < 3; ++c)
    rgb[c] = std::clamp(finite(image.at(x, y, image.channels < 3 ? 0 : c)), 0.0, 1.0);
  return labFromLinearRgb(rgb);
}

bool flickers(const FlickerInput& input, int x, int y, const FlickerSettings& settings) {
  const glm::dvec2 place = previousPlace(input.displacement, x, y);
  if (glm::length(place - glm::dvec2(x + 0.5, y + 0.5)) >= settings.maxDisplacementPx) return false;
  if (!inside(place, input.previousFrame)) return false;
  const bool compareDepth = !input.previousDepth.data.empty();
  const double depth = compareDepth ? finite(input.previousDepthOfPixel.at(x, y)) : 0.0;
  // Bilinear over those texels that show the same surface.
  std::array<double, 3> colour{};
  double weights = 0.0;
  forBilinear(
      place, input.previousFrame.width, input.previousFrame.height, [&](int px, int py, double weight) {
        if (compareDepth) {
          const double there = finite(input.previousDepth.at(px, py));
          const bool background = !(depth > 0.0), backgroundThere = !(there > 0.0);
          if (background != backgroundThere) return;
          if (!background && std::abs(there - depth) > settings.depthTolerance * depth) return;
        }
        weights += weight;
        for (int c = 0; c < 3; ++c)
          colour[c] +=
              weight * finite(input.previousFrame.at(px, py, input.previousFrame.channels < 3 ? 0 : c));
      });
  if (!(weights > 0.0)) return false;
  for (double& value : colour) value = std::clamp(value / weights, 0.0, 1.0);
  const double overTime = differenceCie94(labFromLinearRgb(colour), labAt(input.previousShading, x, y));
  const double overLod = differenceCie94(labAt(input.actual, x, y), labAt(input.predicted, x, y));
  return overLod > 0.0 && overTime >= settings.kappa * overLod;
}

}  // namespace

Image disocclusionWeight(const std::vector<DisocclusionView>& views, const DisocclusionSettings& settings) {
  assert(!views.empty());
  const int width = views.front().displacement.width, height = views.front().displacement.height;
  Image weight(width, height, 1);
  forEachRow(height, static_cast<size_t>(width), [&](int y) {
    for (int x = 0; x < width; ++x) {
      double largest = 0.0;
      for (const DisocclusionView& view : views)
        largest = std::max(largest, visibility(view, x, y, settings));
      weight.at(x, y) = static_cast<float>(largest);
    }
  });
  return weight;
}

Image flickerWeight(const FlickerInput& input, const FlickerSettings& settings) {
  const int width = input.actual.width, height = input.actual.height;
  Image weight(width, height, 1, 1.0F);
  forEachRow(height, static_cast<size_t>(width), [&](int y) {
    for (int x = 0; x < width; ++x)
      if (flickers(input, x, y, settings)) weight.at(x, y) = static_cast<float>(settings.weight);
  });
  return weight;
}

}  // namespace limen::perception
