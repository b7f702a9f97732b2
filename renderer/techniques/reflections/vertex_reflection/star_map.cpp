// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/vertex_reflection/star_map.h"

#include <numbers>

#include "renderer/techniques/reflections/vertex_reflection/star_mesh.h"

namespace limen::reflections {
namespace {

/// One ring of empty texels takes the mean of its neighbours; false if no texel is empty.
bool fillOnce(StarMap& map) {
  const std::vector<RadialPoint> before = map.texels;
  const int n = map.resolution;
  bool empty = false, any = false;
  for (int layer = 0; layer < map.layers(); ++layer)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        RadialPoint& texel = map.texels[(static_cast<size_t>(layer) * n + y) * n + x];
        if (texel.radius > 0.0) continue;
        empty = true;
        RadialPoint sum;
        int count = 0;
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i) {
            int atX = x + i, atY = y + j, atLayer = layer;
            if (map.layout == MapLayout::LatLong) {
              atX = (atX + n) % n;
              if (atY < 0 || atY >= n) continue;
            } else if (atX < 0 || atY < 0 || atX >= n || atY >= n) {
              // Past the face's edge: the texel of the neighbouring face.
              const CubePlace place =
                  cubePlace(cubeDirection({layer, (2.0 * atX + 1.0) / n - 1.0, (2.0 * atY + 1.0) / n - 1.0}));
              const auto cell = [n](double s) {
                return std::min(n - 1, std::max(0, static_cast<int>(0.5 * (s + 1.0) * n)));
              };
              atLayer = place.face, atX = cell(place.s), atY = cell(place.t);
            }
            const RadialPoint& other = before[(static_cast<size_t>(atLayer) * n + atY) * n + atX];
            if (!(other.radius > 0.0)) continue;
            ++count;
            sum.radius += other.radius;
            sum.gradient += other.gradient;
          }
        if (count == 0) continue;
        any = true;
        const glm::dvec3 u = texelDirection(map.layout, n, layer, x, y);
        const glm::dvec3 gradient = sum.gradient / double(count);
        texel = {sum.radius / count, gradient - glm::dot(gradient, u) * u};
      }
  return empty && any;
}

}  // namespace

glm::dvec3 texelDirection(MapLayout layout, int resolution, int layer, int x, int y) {
  const double s = (x + 0.5) / resolution, t = (y + 0.5) / resolution;
  if (layout == MapLayout::Cube) return glm::normalize(cubeDirection({layer, 2.0 * s - 1.0, 2.0 * t - 1.0}));
  const double phi = 2.0 * std::numbers::pi * s, theta = std::numbers::pi * t;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

StarMap bakeStarMap(const StarSurface& surface, MapLayout layout, int resolution, double unit) {
  StarMap map{.layout = layout, .resolution = resolution, .texels = {}, .unit = unit, .present = {}};
  size_t empty = 0;
  for (int layer = 0; layer < map.layers(); ++layer)
    for (int y = 0; y < resolution; ++y)
      for (int x = 0; x < resolution; ++x) {
        RadialPoint at = surface(texelDirection(layout, resolution, layer, x, y));
        at.radius /= unit;
        if (!(at.radius > 0.0)) ++empty, at = {};
        map.present.push_back(at.radius > 0.0 ? 255 : 0);
        map.texels.push_back(at);
      }
  map.filledShare = double(empty) / double(map.texels.size());
  if (empty < map.texels.size())
    while (fillOnce(map)) {
    }
  return map;
}

}  // namespace limen::reflections
