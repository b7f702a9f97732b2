// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"

namespace limen::references {

using Triangle2 = std::array<glm::dvec2, 3>;

/// Triangles, counter-clockwise, that tile a simple counter-clockwise polygon (ear clipping).
std::vector<Triangle2> triangulate(std::vector<glm::dvec2> polygon);

/// Maps the unit square onto a light's shape so that equal areas stay equal: a uniform or stratified set of
/// points remains so. Disc: Shirley and Chiu's concentric map; polygon: area-weighted choice of a triangle.
class LightShapeMap {
 public:
  explicit LightShapeMap(const scene::AreaLight& light);
  /// Unit light coordinates.
  glm::dvec2 operator()(glm::dvec2 square) const;

  scene::LightShape shape() const { return shape_; }
  /// Of a polygon: its triangles, and the share of the area up to and including each.
  const std::vector<Triangle2>& triangles() const { return triangles_; }
  const std::vector<double>& cumulativeShares() const { return cumulative_; }

 private:
  scene::LightShape shape_;
  std::vector<Triangle2> triangles_;
  std::vector<double> cumulative_;
};

}  // namespace limen::references
