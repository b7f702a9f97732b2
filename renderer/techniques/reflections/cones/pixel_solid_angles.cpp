// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/cones/pixel_solid_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limen::techniques {
namespace {

/// Solid angle of the rectangle from (0, 0) to (x, y) in the plane z = 1, signed.
double cornerAngle(double x, double y) { return std::atan2(x * y, std::sqrt(1.0 + x * x + y * y)); }

}  // namespace

PixelSolidAngles::PixelSolidAngles(glm::ivec2 sizePx, double tanHalfFov)
    : sizePx_(sizePx), quadrantPx_((sizePx + 1) / 2) {
  const double pitch = 2.0 * tanHalfFov / sizePx.y;
  quadrant_.reserve(static_cast<size_t>(quadrantPx_.x) * static_cast<size_t>(quadrantPx_.y));
  for (int y = 0; y < quadrantPx_.y; ++y)
    for (int x = 0; x < quadrantPx_.x; ++x) {
      const glm::dvec2 low = (glm::dvec2(x, y) - 0.5 * glm::dvec2(sizePx)) * pitch, high = low + pitch;
      quadrant_.push_back(cornerAngle(high.x, high.y) - cornerAngle(low.x, high.y) -
                          cornerAngle(high.x, low.y) + cornerAngle(low.x, low.y));
    }
}

double PixelSolidAngles::at(glm::ivec2 pixel) const {
  const glm::ivec2 mirrored = glm::min(pixel, sizePx_ - 1 - pixel);
  return quadrant_[static_cast<size_t>(mirrored.y) * static_cast<size_t>(quadrantPx_.x) +
                   static_cast<size_t>(mirrored.x)];
}

double coneHalfAngle(double solidAngleSr) {
  // 1 - cos a = 2 sin^2(a / 2) keeps small angles.
  return 2.0 * std::asin(std::sqrt(std::clamp(solidAngleSr / (4.0 * std::numbers::pi), 0.0, 1.0)));
}

}  // namespace limen::techniques
