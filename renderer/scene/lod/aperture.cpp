// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/lod/aperture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limen::scene {
namespace {

constexpr double kPi = std::numbers::pi;

double angleBetween(glm::dvec3 a, glm::dvec3 b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Angle at the corner opposite to side `a` of a spherical triangle with half-circumference s.
double cornerAngle(double s, double a, double b, double c) {
  const double above = std::sin(s - b) * std::sin(s - c), below = std::sin(s) * std::sin(s - a);
  return 2.0 * std::atan2(std::sqrt(std::max(above, 0.0)), std::sqrt(std::max(below, 0.0)));
}

double capArea(double radius) {
  const double half = std::sin(0.5 * radius);
  return 4.0 * kPi * half * half;
}

}  // namespace

std::vector<double> horizon(const HeightField& field, double highest, int i, int j, int azimuths) {
  const glm::dvec3 point = field.point(i, j);
  const double high = field.low + field.spacing * (field.side - 1);
  std::vector<double> out;
  for (int k = 0; k < azimuths; ++k) {
    const double azimuth = 2.0 * kPi * (k + 0.5) / azimuths, x = std::cos(azimuth), z = std::sin(azimuth);
    double steepest = 0.0;  // tangent of the elevation
    for (double distance = field.spacing;; distance += field.spacing) {
      const double px = point.x + distance * x, pz = point.z + distance * z;
      if (px < field.low || pz < field.low || px > high || pz > high) break;
      if (highest - point.y <= steepest * distance) break;  // nothing farther can stand higher
      steepest = std::max(steepest, (field.height(px, pz) - point.y) / distance);
    }
    out.push_back(std::atan(steepest));
  }
  return out;
}

Aperture apertureOf(const std::vector<double>& horizonRad) {
  const double sector = 2.0 * kPi / static_cast<double>(horizonRad.size());
  double solidAngle = 0.0;
  glm::dvec3 mean(0.0);
  for (size_t k = 0; k < horizonRad.size(); ++k) {
    const double h = horizonRad[k], azimuth = sector * (static_cast<double>(k) + 0.5);
    // Over elevations e from h to pi/2: of cos e; of cos^2 e; of sin e cos e.
    solidAngle += sector * (1.0 - std::sin(h));
    const double outwards = 0.5 * (0.5 * kPi - h) - 0.25 * std::sin(2.0 * h),
                 upwards = 0.5 * std::cos(h) * std::cos(h);
    // A direction represents its sector: its mean over the sector is shorter by sin(x) / x, x being half the
    // sector.
    const double width = 2.0 * std::sin(0.5 * sector);
    mean += glm::dvec3(width * outwards * std::cos(azimuth), sector * upwards,
                       width * outwards * std::sin(azimuth));
  }
  Aperture out;
  if (glm::length(mean) > 0.0) out.axis = glm::normalize(mean);
  out.angleRad = std::acos(std::clamp(1.0 - solidAngle / (2.0 * kPi), -1.0, 1.0));
  return out;
}

std::vector<Aperture> apertures(const HeightField& field, int azimuths) {
  const double highest = field.highest();
  std::vector<Aperture> out;
  for (int j = 0; j < field.side; ++j)
    for (int i = 0; i < field.side; ++i) out.push_back(apertureOf(horizon(field, highest, i, j, azimuths)));
  return out;
}

double capIntersection(double a, double b, double d) {
  if (d >= a + b) return 0.0;
  if (d <= std::abs(a - b)) return capArea(std::min(a, b));
  // Caps that together reach around the sphere: what neither covers is the lens of their complements.
  if (a + b + d >= 2.0 * kPi) return capArea(a) + capArea(b) - 4.0 * kPi;
  // Two sectors minus the kite between both axes and both crossings of the rims. Sectors and the kite's
  // spherical excess in half-angle forms, which stay accurate for small caps.
  const double s = 0.5 * (a + b + d);
  const double atA = cornerAngle(s, b, a, d), atB = cornerAngle(s, a, b, d);
  const double product =
      std::tan(0.5 * s) * std::tan(0.5 * (s - a)) * std::tan(0.5 * (s - b)) * std::tan(0.5 * (s - d));
  const double excess = 4.0 * std::atan(std::sqrt(std::max(product, 0.0)));
  return std::max((atA * capArea(a) + atB * capArea(b)) / kPi - 2.0 * excess, 0.0);
}

ApertureLight apertureLight(const Aperture& aperture, glm::dvec3 normal, glm::dvec3 toSun,
                            double sunRadiusRad) {
  const double seen = capIntersection(aperture.angleRad, sunRadiusRad, angleBetween(aperture.axis, toSun));
  const double whole = capArea(sunRadiusRad), s = std::sin(aperture.angleRad);
  return {whole > 0.0 ? seen / whole * std::max(glm::dot(normal, toSun), 0.0) : 0.0,
          s * s * std::max(glm::dot(normal, aperture.axis), 0.0)};
}

}  // namespace limen::scene
