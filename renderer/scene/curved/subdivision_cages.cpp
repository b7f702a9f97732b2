// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/curved/subdivision_cages.h"

#include <cmath>
#include "renderer/scene/curved/double_torus.h"

namespace limen::scene {

surfaces::PolygonMesh pyramids(uint32_t valence) {
  surfaces::PolygonMesh mesh;
  mesh.points = {{0.1, 1.0, 0.0}, {0.0, -1.2, 0.1}};
  for (uint32_t i = 0; i < valence; ++i) {
    const double turn = 2.0 * M_PI * i / valence, radius = 1.0 + 0.15 * std::sin(3.0 * turn + 1.0);
    mesh.points.emplace_back(radius * std::cos(turn), 0.1 * std::cos(2.0 * turn), -radius * std::sin(turn));
    const uint32_t a = 2 + i, b = 2 + (i + 1) % valence;
    mesh.faces.push_back({0, a, b});
    mesh.faces.push_back({1, b, a});
  }
  return mesh;
}

surfaces::PolygonMesh tetrahedron() {
  surfaces::PolygonMesh mesh;
  mesh.points = {{0.0, 1.0, 0.0}, {1.0, -0.4, 0.6}, {0.0, -0.4, -1.1}, {-1.0, -0.4, 0.6}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  return mesh;
}

surfaces::PolygonMesh bumpySheet(uint32_t side, bool quads) {
  surfaces::PolygonMesh mesh;
  for (uint32_t y = 0; y <= side; ++y)
    for (uint32_t x = 0; x <= side; ++x)
      mesh.points.emplace_back(x, y, 0.7 * std::sin(2.1 * x + 0.3 * y) * std::cos(1.7 * y));
  for (uint32_t y = 0; y < side; ++y)
    for (uint32_t x = 0; x < side; ++x) {
      const uint32_t a = x + (side + 1) * y, b = a + 1, c = b + side + 1, d = c - 1;
      if (quads)
        mesh.faces.push_back({a, b, c, d});
      else
        mesh.faces.insert(mesh.faces.end(), {{a, b, c}, {a, c, d}});
    }
  return mesh;
}

surfaces::PolygonMesh openFan(uint32_t faces) {
  surfaces::PolygonMesh mesh;
  mesh.points = {{0.0, 0.0, 0.2}};
  for (uint32_t i = 0; i <= faces; ++i) {
    const double turn = M_PI * i / faces;
    mesh.points.emplace_back(std::cos(turn), std::sin(turn), 0.2 * std::sin(5.0 * i));
  }
  for (uint32_t i = 0; i < faces; ++i) mesh.faces.push_back({0, 1 + i, 2 + i});
  return mesh;
}

namespace {

surfaces::PolygonMesh block() {
  surfaces::PolygonMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.emplace_back(i & 1 ? 0.6 : -0.6, i & 2 ? 1.0 : 0.0, i & 4 ? 0.45 : -0.45);
  mesh.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return mesh;
}

surfaces::PolygonMesh house() {
  surfaces::PolygonMesh mesh;
  for (int level = 0; level < 2; ++level)
    for (int i = 0; i < 5; ++i)
      mesh.points.emplace_back(0.6 * std::cos(0.4 * M_PI * i), 0.7 * level, -0.6 * std::sin(0.4 * M_PI * i));
  mesh.points.emplace_back(0.0, 1.2, 0.0);
  mesh.faces = {{4, 3, 2, 1, 0}};
  for (uint32_t i = 0; i < 5; ++i) {
    const uint32_t next = (i + 1) % 5;
    mesh.faces.push_back({i, next, next + 5, i + 5});
    mesh.faces.push_back({i + 5, next + 5, 10});
  }
  return mesh;
}

/// Vertices are numbered by their coordinates: bit 1 is up.
void sharpen(surfaces::PolygonMesh& mesh, bool corners) {
  const auto edge = [&](uint32_t a, uint32_t b) {
    mesh.sharpness[surfaces::edgeKey(a, b)] = surfaces::kInfinitelySharp;
  };
  for (const uint32_t level : {0U, 2U}) {
    edge(level, level + 1), edge(level + 1, level + 5);
    edge(level + 5, level + 4), edge(level + 4, level);
  }
  if (corners) edge(0, 2), edge(5, 7);
}

}  // namespace

surfaces::PolygonMesh closedCage(CageShape shape) {
  surfaces::PolygonMesh mesh;
  if (shape == CageShape::House) return house();
  if (shape == CageShape::DoubleTorus) {
    mesh = doubleTorusCage();
    for (glm::dvec3& p : mesh.points) p = {p.x, -p.z, p.y};
    return mesh;
  }
  mesh = block();
  if (shape != CageShape::Block) sharpen(mesh, shape == CageShape::CorneredBlock);
  return mesh;
}

surfaces::SubdivisionSurface seamedRing(bool quads) {
  constexpr uint32_t kAlong = 10, kAround = 6;
  surfaces::SubdivisionSurface out;
  out.scheme = quads ? surfaces::SubdivisionScheme::CatmullClark : surfaces::SubdivisionScheme::Loop;
  surfaces::CornerAttributes& attributes = out.attributes.emplace();
  const auto point = [](uint32_t i, uint32_t j) {
    const double along = 2.0 * M_PI * i / kAlong, around = 2.0 * M_PI * j / kAround;
    const double radius = 1.0 + 0.4 * std::cos(around);
    return glm::dvec3(radius * std::cos(along), radius * std::sin(along), 0.4 * std::sin(around));
  };
  for (uint32_t j = 0; j < kAround; ++j)
    for (uint32_t i = 0; i < kAlong; ++i) out.cage.points.push_back(point(i, j));
  for (uint32_t j = 0; j <= kAround; ++j)
    for (uint32_t i = 0; i <= kAlong; ++i)
      attributes.values.emplace_back(double(i) / kAlong, double(j) / kAround,
                                     point(i % kAlong, j % kAround).y);
  const auto add = [&](const std::vector<std::array<uint32_t, 2>>& corners) {
    std::vector<uint32_t>&face = out.cage.faces.emplace_back(), &values = attributes.faces.emplace_back();
    for (const auto& [i, j] : corners) {
      face.push_back(i % kAlong + kAlong * (j % kAround));
      values.push_back(i + (kAlong + 1) * j);
    }
  };
  for (uint32_t j = 0; j < kAround; ++j)
    for (uint32_t i = 0; i < kAlong; ++i) {
      if (quads) {
        add({{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}});
        continue;
      }
      add({{i, j}, {i + 1, j}, {i + 1, j + 1}});
      add({{i, j}, {i + 1, j + 1}, {i, j + 1}});
    }
  return out;
}

}  // namespace limen::scene
