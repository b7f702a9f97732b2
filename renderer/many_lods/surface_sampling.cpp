// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/surface_sampling.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "experiments/base/error.h"

namespace limen::many_lods {
namespace {

double areaOf(const std::vector<glm::dvec3>& positions, glm::uvec3 triangle) {
  const glm::dvec3 a = positions[triangle.x];
  const double area = 0.5 * glm::length(glm::cross(positions[triangle.y] - a, positions[triangle.z] - a));
  return std::isfinite(area) ? area : 0.0;
}

uint32_t packPlace(double s, double t) {
  const auto whole = [](double share) {
    return static_cast<uint32_t>(std::lround(std::clamp(share, 0.0, 1.0) * 65535.0));
  };
  const uint32_t first = whole(s);
  return first | std::min(whole(t), 65535U - first) << 16;
}

/// Of an integer, uniform in [0,1).
double hashed(uint64_t value) {
  value += 0x9e3779b97f4a7c15ULL;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebULL;
  value ^= value >> 31;
  return static_cast<double>(value >> 11) * 0x1p-53;
}

double fraction(double value) { return value - std::floor(value); }

}  // namespace

double surfaceArea(const std::vector<glm::dvec3>& positions, const std::vector<glm::uvec3>& triangles) {
  double sum = 0.0;
  for (const glm::uvec3 triangle : triangles) sum += areaOf(positions, triangle);
  return sum;
}

std::vector<SurfaceSample> sampleSurface(const std::vector<glm::dvec3>& positions,
                                         const std::vector<glm::uvec3>& triangles, uint32_t count,
                                         uint64_t seed) {
  std::vector<double> upTo(triangles.size());
  double sum = 0.0;
  for (size_t i = 0; i < triangles.size(); ++i) upTo[i] = sum += areaOf(positions, triangles[i]);
  if (!(sum > 0.0) || !std::isfinite(sum))
    throw Error("no surface to put points on: the scene's triangles have no area", {},
                "use a scene with a surface");
  std::vector<SurfaceSample> out;
  out.reserve(count);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  // R2 of Roberts: powers of the inverse of the plastic number.
  constexpr double kFirst = 0.7548776662466927, kSecond = 0.5698402909980532;
  size_t triangle = 0;
  uint64_t inTriangle = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const double at = (i + unit(random)) / count * sum;
    while (triangle + 1 < triangles.size() && !(at < upTo[triangle])) ++triangle, inTriangle = 0;
    // Rounding at the very end could stop at triangles without area.
    size_t chosen = triangle;
    while (chosen > 0 && !(upTo[chosen] > upTo[chosen - 1])) --chosen;
    const uint64_t key = (seed + 1) * 0x2545f4914f6cdd1dULL + 2 * chosen;
    double s = fraction(hashed(key) + kFirst * static_cast<double>(inTriangle));
    double t = fraction(hashed(key + 1) + kSecond * static_cast<double>(inTriangle));
    if (s + t > 1.0) s = 1.0 - s, t = 1.0 - t;
    ++inTriangle;
    out.push_back({static_cast<uint32_t>(chosen), packPlace(s, t)});
  }
  return out;
}

glm::dvec3 positionOf(const SurfaceSample& sample, const std::vector<glm::dvec3>& positions,
                      const std::vector<glm::uvec3>& triangles) {
  const glm::uvec3 corners = triangles[sample.triangle];
  return positions[corners.x] * (1.0 - sample.s() - sample.t()) + positions[corners.y] * sample.s() +
         positions[corners.z] * sample.t();
}

}  // namespace limen::many_lods
