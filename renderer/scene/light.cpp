// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/light.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/base/error.h"

namespace limen::scene {
namespace {

/// A few units in the last place of coordinates of the magnitude of `p` and its neighbours.
double roundingOf(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
  const glm::dvec2 largest = glm::max(glm::max(glm::abs(a), glm::abs(b)), glm::abs(p));
  return 4.0 * std::numeric_limits<double>::epsilon() * std::max(largest.x, largest.y);
}

/// Sign of the area of (a, b, p); 0 if rounding of the coordinates or of the determinant could have decided
/// it.
int orientation(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
  const glm::dvec2 edge = b - a, to = p - a;
  const double determinant = edge.x * to.y - edge.y * to.x;
  const double bound = roundingOf(a, b, p) * (std::abs(edge.x) + std::abs(edge.y));
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  return 0;
}

bool withinBox(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
  const double margin = roundingOf(a, b, p);
  return p.x >= std::min(a.x, b.x) - margin && p.x <= std::max(a.x, b.x) + margin &&
         p.y >= std::min(a.y, b.y) - margin && p.y <= std::max(a.y, b.y) + margin;
}

bool onSegment(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
  return orientation(a, b, p) == 0 && withinBox(a, b, p);
}

bool segmentsMeet(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
  if (onSegment(a, b, c) || onSegment(a, b, d) || onSegment(c, d, a) || onSegment(c, d, b)) return true;
  return orientation(a, b, c) * orientation(a, b, d) < 0 && orientation(c, d, a) * orientation(c, d, b) < 0;
}

void checkOutline(const std::vector<glm::dvec2>& outline, const std::string& where) {
  const std::string hint = "give a simple polygon, counter-clockwise, in [0,1]^2";
  const size_t n = outline.size();
  if (n < 3) throw Error("a light's outline has " + std::to_string(n) + " vertices", where, hint);
  for (const glm::dvec2 vertex : outline)
    if (!(vertex.x >= 0.0 && vertex.x <= 1.0 && vertex.y >= 0.0 && vertex.y <= 1.0))
      throw Error("a light's outline leaves its bounding rectangle", where, hint);
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec2 a = outline[i], b = outline[(i + 1) % n], c = outline[(i + 2) % n];
    if (a == b) throw Error("a light's outline repeats a vertex", where, hint);
    if (orientation(a, b, c) == 0 && glm::dot(b - a, c - b) <= 0.0)
      throw Error("a light's outline turns back on itself", where, hint);
    for (size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n == i) continue;
      if (segmentsMeet(a, b, outline[j], outline[(j + 1) % n]))
        throw Error("a light's outline crosses itself", where, hint);
    }
  }
  if (!(signedArea(outline) > 0.0)) throw Error("a light's outline is clockwise or has no area", where, hint);
}

}  // namespace

double signedArea(const std::vector<glm::dvec2>& polygon) {
  double twice = 0.0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    // Relative to the first vertex, so that a small polygon far from the origin keeps its precision.
    const glm::dvec2 a = polygon[i] - polygon[0], b = polygon[(i + 1) % polygon.size()] - polygon[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

bool polygonContains(const std::vector<glm::dvec2>& polygon, glm::dvec2 point) {
  int winding = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const int side = orientation(a, b, point);
    if (side == 0 && withinBox(a, b, point)) return true;
    if (a.y <= point.y && b.y > point.y && side > 0) ++winding;
    if (a.y > point.y && b.y <= point.y && side < 0) --winding;
  }
  return winding != 0;
}

std::vector<glm::dvec2> lightOutline(const AreaLight& light, int discVertices) {
  switch (light.shape) {
    case LightShape::Rectangle:
      return {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
    case LightShape::Polygon:
      return light.outline;
    case LightShape::Disc:
      break;
  }
  std::vector<glm::dvec2> outline;
  for (int i = 0; i < discVertices; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / discVertices;
    outline.emplace_back(0.5 + 0.5 * std::cos(angle), 0.5 + 0.5 * std::sin(angle));
  }
  return outline;
}

void checkLight(const AreaLight& light, const std::string& where) {
  constexpr double kTolerance = 1e-9;
  if (!(light.size.x > 0.0 && light.size.y > 0.0 && std::isfinite(light.size.x) &&
        std::isfinite(light.size.y)))
    throw Error("a light's extents are not positive", where, "give both a size above 0");
  if (!(std::abs(glm::length(light.axisX) - 1.0) < kTolerance &&
        std::abs(glm::length(light.axisY) - 1.0) < kTolerance &&
        std::abs(glm::dot(light.axisX, light.axisY)) < kTolerance))
    throw Error("a light's axes are not unit and perpendicular", where, "normalise and orthogonalise them");
  if (light.shape == LightShape::Polygon) checkOutline(light.outline, where);
  if (light.parts.empty())
    throw Error("a light has no part", where, "give it one part with an empty outline");
  for (const LightPart& part : light.parts) {
    if (!part.outline.empty()) checkOutline(part.outline, where);
    for (int channel = 0; channel < 3; ++channel)
      if (!(part.radiance[channel] >= 0.0F && std::isfinite(part.radiance[channel])))
        throw Error("a light's radiance is negative or not finite", where, "give a radiance of 0 or more");
  }
}

AreaLight withShape(AreaLight light, LightShape shape) {
  light.shape = shape;
  light.outline.clear();
  if (shape == LightShape::Polygon)
    light.outline = {{1.0, 0.5}, {0.75, 1.0}, {0.25, 1.0}, {0.0, 0.5}, {0.25, 0.0}, {0.75, 0.0}};
  return light;
}

bool AreaLight::contains(glm::dvec2 unit) const {
  switch (shape) {
    case LightShape::Rectangle:
      return unit.x >= 0.0 && unit.x <= 1.0 && unit.y >= 0.0 && unit.y <= 1.0;
    case LightShape::Polygon:
      return polygonContains(outline, unit);
    case LightShape::Disc:
      break;
  }
  // A point computed on the edge may miss it by the rounding of its own coordinates.
  constexpr double kEdge = 1.0 + 8.0 * std::numeric_limits<double>::epsilon();
  const glm::dvec2 fromCentre = 2.0 * unit - 1.0;
  return glm::dot(fromCentre, fromCentre) <= kEdge;
}

double AreaLight::area() const {
  const double rectangle = size.x * size.y;
  switch (shape) {
    case LightShape::Rectangle:
      return rectangle;
    case LightShape::Disc:
      return 0.25 * std::numbers::pi * rectangle;
    case LightShape::Polygon:
      return signedArea(outline) * rectangle;
  }
  return rectangle;
}

glm::dmat4 AreaLight::toLightSpace(glm::dvec3 anchor) const {
  const glm::dvec3 z = direction(), shift = anchor - centre;
  glm::dmat4 matrix(1.0);
  for (int column = 0; column < 3; ++column)
    matrix[column] = glm::dvec4(axisX[column], axisY[column], z[column], 0.0);
  matrix[3] = glm::dvec4(glm::dot(axisX, shift), glm::dot(axisY, shift), glm::dot(z, shift), 1.0);
  return matrix;
}

}  // namespace limen::scene
