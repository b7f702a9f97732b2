// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/light_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/references/convex_pieces.h"

namespace limen::references {
namespace {

double twiceArea(const Triangle2& t) { return cross2(t[1] - t[0], t[2] - t[0]); }

bool covers(const Triangle2& t, glm::dvec2 p) {
  for (size_t i = 0; i < 3; ++i)
    if (cross2(t[(i + 1) % 3] - t[i], p - t[i]) < 0.0) return false;
  return true;
}

bool isEar(const std::vector<glm::dvec2>& polygon, size_t at) {
  const size_t n = polygon.size();
  const Triangle2 ear = {polygon[(at + n - 1) % n], polygon[at], polygon[(at + 1) % n]};
  if (!(twiceArea(ear) > 0.0)) return false;
  return std::none_of(polygon.begin(), polygon.end(), [&](glm::dvec2 p) {
    return p != ear[0] && p != ear[1] && p != ear[2] && covers(ear, p);
  });
}

glm::dvec2 concentric(glm::dvec2 square) {
  const glm::dvec2 p = 2.0 * square - 1.0;
  if (p.x == 0.0 && p.y == 0.0) return {0.5, 0.5};
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const double radius = wide ? p.x : p.y;
  const double angle = wide ? std::numbers::pi / 4.0 * (p.y / p.x)
                            : std::numbers::pi / 2.0 - std::numbers::pi / 4.0 * (p.x / p.y);
  return 0.5 + 0.5 * radius * glm::dvec2(std::cos(angle), std::sin(angle));
}

}  // namespace

std::vector<Triangle2> triangulate(std::vector<glm::dvec2> polygon) {
  std::vector<Triangle2> triangles;
  while (polygon.size() > 3) {
    const size_t n = polygon.size();
    size_t at = 0;
    while (at < n && !isEar(polygon, at)) ++at;
    // A simple polygon has an ear unless vertices are collinear; such a vertex cuts off nothing.
    if (at == n) {
      at = 0;
      for (size_t i = 0; i < n; ++i)
        if (std::abs(cross2(polygon[i] - polygon[(i + n - 1) % n], polygon[(i + 1) % n] - polygon[i])) <
            std::abs(cross2(polygon[at] - polygon[(at + n - 1) % n], polygon[(at + 1) % n] - polygon[at])))
          at = i;
    } else {
      triangles.push_back({polygon[(at + n - 1) % n], polygon[at], polygon[(at + 1) % n]});
    }
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(at));
  }
  if (polygon.size() == 3) triangles.push_back({polygon[0], polygon[1], polygon[2]});
  return triangles;
}

LightShapeMap::LightShapeMap(const scene::AreaLight& light) : shape_(light.shape) {
  if (shape_ != scene::LightShape::Polygon) return;
  triangles_ = triangulate(light.outline);
  double sum = 0.0;
  for (const Triangle2& triangle : triangles_) cumulative_.push_back(sum += twiceArea(triangle));
  for (double& share : cumulative_) share /= sum;
}

glm::dvec2 LightShapeMap::operator()(glm::dvec2 square) const {
  switch (shape_) {
    case scene::LightShape::Rectangle:
      return square;
    case scene::LightShape::Disc:
      return concentric(square);
    case scene::LightShape::Polygon:
      break;
  }
  size_t which = 0;
  while (which + 1 < triangles_.size() && square.x >= cumulative_[which]) ++which;
  const double low = which ? cumulative_[which - 1] : 0.0, share = cumulative_[which] - low;
  const double u = share > 0.0 ? glm::clamp((square.x - low) / share, 0.0, 1.0) : 0.5;
  const Triangle2& t = triangles_[which];
  const double root = std::sqrt(u);
  return t[0] * (1.0 - root) + (t[1] * (1.0 - square.y) + t[2] * square.y) * root;
}

}  // namespace limen::references
