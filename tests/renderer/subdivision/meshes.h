// SPDX-License-Identifier: BSD-3-Clause
// Control meshes that subdivision may trip over.
#pragma once

#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

/// Two pyramids, base to base: two vertices of the valence, all others of valence 4; uneven.
inline PolygonMesh bipyramid(uint32_t valence) {
  PolygonMesh mesh;
  mesh.points = {{0.1, 0.0, 1.0}, {0.0, 0.1, -1.2}};
  for (uint32_t i = 0; i < valence; ++i) {
    const double turn = 2.0 * M_PI * i / valence, radius = 1.0 + 0.2 * std::sin(3.0 * i);
    mesh.points.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 0.1 * std::cos(2.0 * i));
    const uint32_t a = 2 + i, b = 2 + (i + 1) % valence;
    mesh.faces.push_back({0, a, b});
    mesh.faces.push_back({1, b, a});
  }
  return mesh;
}

/// Triangles around a vertex of the boundary, which is vertex 0.
inline PolygonMesh boundaryFan(uint32_t faces) {
  PolygonMesh mesh;
  mesh.points = {{0.0, 0.0, 0.2}};
  for (uint32_t i = 0; i <= faces; ++i) {
    const double turn = M_PI * i / faces;
    mesh.points.emplace_back(std::cos(turn), std::sin(turn), 0.3 * std::sin(5.0 * i));
  }
  for (uint32_t i = 0; i < faces; ++i) mesh.faces.push_back({0, 1 + i, 2 + i});
  return mesh;
}

/// A bumpy open sheet of triangles or quads.
inline PolygonMesh openSheet(uint32_t side, bool triangles) {
  scene::Random random(12);
  PolygonMesh mesh;
  for (uint32_t y = 0; y <= side; ++y)
    for (uint32_t x = 0; x <= side; ++x) mesh.points.emplace_back(x, y, random.uniform(-0.6, 0.6));
  for (uint32_t y = 0; y < side; ++y)
    for (uint32_t x = 0; x < side; ++x) {
      const uint32_t a = x + (side + 1) * y, b = a + 1, c = b + side + 1, d = c - 1;
      mesh.faces.push_back({a, b, c, d});
    }
  return triangles ? triangulated(std::move(mesh)) : mesh;
}

}  // namespace limen::surfaces
