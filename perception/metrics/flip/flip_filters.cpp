// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/flip/flip_filters.h"

#include <array>
#include <cmath>
#include <numbers>

namespace limen::perception {
namespace {

constexpr double kPi = std::numbers::pi;

/// One Gaussian of a contrast sensitivity function, a sqrt(pi / b) exp(-pi^2 x^2 / b) for x in degrees.
struct Gaussian {
  double a, b;
};
constexpr Gaussian kAchromatic{1.0, 0.0047}, kRedGreen{1.0, 0.0053}, kBlueYellow1{34.1, 0.04},
    kBlueYellow2{13.5, 0.025};
constexpr double kWidestB = 0.04;
/// Width of the feature detectors, degrees: twice the standard deviation of their Gaussian.
constexpr double kFeatureWidthDeg = 0.082;

double gaussianTap(const Gaussian& gaussian, int tap, double pixelsPerDegree) {
  const double x = tap / pixelsPerDegree;
  return std::exp(-kPi * kPi * x * x / gaussian.b);
}

std::vector<glm::vec4> makeSensitivity(int radius, double pixelsPerDegree) {
  constexpr std::array<Gaussian, 4> kParts = {kAchromatic, kRedGreen, kBlueYellow1, kBlueYellow2};
  std::array<double, 4> sums{};
  for (size_t part = 0; part < kParts.size(); ++part)
    for (int tap = -radius; tap <= radius; ++tap)
      sums[part] += gaussianTap(kParts[part], tap, pixelsPerDegree);
  // A sum of two Gaussians is not separable but each of them is. Both are normalised separately and then
  // weighted by their shares of the two-dimensional sum, with a square root since the kernel is applied
  // twice.
  const auto weight = [&](size_t part) {
    return kParts[part].a * std::sqrt(kPi / kParts[part].b) * sums[part] * sums[part];
  };
  const double total = weight(2) + weight(3);
  const std::array<double, 4> scales = {1.0, 1.0, std::sqrt(weight(2) / total), std::sqrt(weight(3) / total)};
  std::vector<glm::vec4> taps;
  for (int tap = -radius; tap <= radius; ++tap) {
    glm::dvec4 value;
    for (size_t part = 0; part < kParts.size(); ++part)
      value[static_cast<int>(part)] =
          scales[part] * gaussianTap(kParts[part], tap, pixelsPerDegree) / sums[part];
    taps.emplace_back(value);
  }
  return taps;
}

std::vector<glm::vec4> makeFeatures(int radius, double pixelsPerDegree) {
  const double deviation = 0.5 * kFeatureWidthDeg * pixelsPerDegree;
  const int ownRadius = static_cast<int>(std::ceil(3.0 * deviation));
  std::vector<glm::dvec3> raw;
  glm::dvec3 positive(0.0), negative(0.0);
  for (int tap = -radius; tap <= radius; ++tap) {
    const bool inside = std::abs(tap) <= ownRadius;
    const double scaled = tap / deviation;
    const double gaussian = inside ? std::exp(-0.5 * scaled * scaled) : 0.0;
    raw.emplace_back(gaussian, -tap * gaussian, (scaled * scaled - 1.0) * gaussian);
    positive += glm::max(raw.back(), 0.0), negative -= glm::min(raw.back(), 0.0);
  }
  // Positive weights sum to 1 and negative ones to -1, so that a detector's response to any image is in [-1,
  // 1].
  std::vector<glm::vec4> taps;
  for (const glm::dvec3& value : raw) {
    glm::dvec3 normalised(0.0);
    for (int i = 0; i < 3; ++i)
      if (value[i] != 0.0) normalised[i] = value[i] / (value[i] > 0.0 ? positive[i] : negative[i]);
    taps.emplace_back(glm::vec3(normalised), 0.0F);
  }
  return taps;
}

}  // namespace

FlipFilters makeFlipFilters(double pixelsPerDegree) {
  FlipFilters filters;
  // Three standard deviations of the widest Gaussian. The feature detectors are never wider (0.123 against
  // 0.135 deg).
  filters.radius =
      static_cast<int>(std::ceil(3.0 * std::sqrt(kWidestB / (2.0 * kPi * kPi)) * pixelsPerDegree));
  filters.sensitivity = makeSensitivity(filters.radius, pixelsPerDegree);
  filters.features = makeFeatures(filters.radius, pixelsPerDegree);
  return filters;
}

}  // namespace limen::perception
