// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/shapes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace limen::scene {
namespace {

void addQuad(Mesh& mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  mesh.triangles.emplace_back(a, b, c);
  mesh.triangles.emplace_back(a, c, d);
}

/// Keeps a vertex attribute either empty or one per vertex; zeros for a mesh that has none.
template <class Value>
void appendAttribute(std::vector<Value>& to, const std::vector<Value>& more, size_t before, size_t after) {
  if (to.empty() && more.empty()) return;
  to.resize(before, Value(0.0F));
  to.insert(to.end(), more.begin(), more.end());
  to.resize(after, Value(0.0F));
}

}  // namespace

Mesh cardGrid(glm::dvec3 centre, glm::dvec3 halfA, glm::dvec3 halfB, int cells) {
  assert(cells > 0);
  Mesh mesh;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i)
      mesh.positions.push_back(centre + halfA * (2.0 * i / cells - 1.0) + halfB * (2.0 * j / cells - 1.0));
  const auto stride = static_cast<uint32_t>(cells + 1);
  for (uint32_t j = 0; j + 1 < stride; ++j)
    for (uint32_t i = 0; i + 1 < stride; ++i) {
      const uint32_t corner = j * stride + i;
      addQuad(mesh, corner, corner + 1, corner + stride + 1, corner + stride);
    }
  return mesh;
}

Mesh card(glm::dvec3 centre, glm::dvec3 halfA, glm::dvec3 halfB) { return cardGrid(centre, halfA, halfB, 1); }

Mesh planeGrid(glm::dvec3 centre, double sizeX, double sizeZ, int cells) {
  return cardGrid(centre, {0.0, 0.0, 0.5 * sizeZ}, {0.5 * sizeX, 0.0, 0.0}, cells);
}

Mesh hexahedron(const std::array<glm::dvec3, 8>& corners) {
  Mesh mesh;
  mesh.positions.assign(corners.begin(), corners.end());
  addQuad(mesh, 3, 2, 1, 0);
  addQuad(mesh, 4, 5, 6, 7);
  for (uint32_t i = 0; i < 4; ++i) addQuad(mesh, i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i);
  return mesh;
}

Mesh box(glm::dvec3 low, glm::dvec3 high) {
  return hexahedron({glm::dvec3(low.x, low.y, high.z), glm::dvec3(high.x, low.y, high.z),
                     glm::dvec3(high.x, low.y, low.z), low, glm::dvec3(low.x, high.y, high.z), high,
                     glm::dvec3(high.x, high.y, low.z), glm::dvec3(low.x, high.y, low.z)});
}

Mesh sphere(glm::dvec3 centre, double radius, int cells) {
  assert(cells > 0);
  Mesh mesh;
  std::map<std::tuple<int, int, int>, uint32_t> known;
  // Lattice points of the octahedron |x| + |y| + |z| = cells are shared by the faces that meet there.
  const auto vertex = [&](int x, int y, int z) {
    const auto [entry, fresh] =
        known.emplace(std::tuple(x, y, z), static_cast<uint32_t>(mesh.positions.size()));
    if (fresh) mesh.positions.push_back(centre + radius * glm::normalize(glm::dvec3(x, y, z)));
    return entry->second;
  };
  for (const int sx : {-1, 1})
    for (const int sy : {-1, 1})
      for (const int sz : {-1, 1}) {
        const bool mirrored = sx * sy * sz < 0;
        const auto at = [&](int i, int j) { return vertex(sx * (cells - i - j), sy * i, sz * j); };
        // Braces at the calls fix the order in which vertices are numbered.
        const auto add = [&](const std::array<uint32_t, 3>& v) {
          mesh.triangles.push_back(mirrored ? glm::uvec3(v[0], v[2], v[1]) : glm::uvec3(v[0], v[1], v[2]));
        };
        for (int i = 0; i < cells; ++i)
          for (int j = 0; i + j < cells; ++j) {
            add({at(i, j), at(i + 1, j), at(i, j + 1)});
            if (i + j + 1 < cells) add({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
          }
      }
  return mesh;
}

Mesh frustum(glm::dvec3 base, glm::dvec3 top, double baseRadius, double topRadius, int segments) {
  assert(segments >= 3 && baseRadius > 0.0);
  Mesh mesh;
  const glm::dvec3 axis = glm::normalize(top - base), a = perpendicular(axis), b = glm::cross(axis, a);
  const auto n = static_cast<uint32_t>(segments);
  const auto ring = [&](glm::dvec3 centre, double radius) {
    for (uint32_t i = 0; i < n; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / n;
      mesh.positions.push_back(centre + radius * (std::cos(angle) * a + std::sin(angle) * b));
    }
  };
  ring(base, baseRadius);
  if (topRadius > 0.0) ring(top, topRadius);
  const auto baseCentre = static_cast<uint32_t>(mesh.positions.size()), topCentre = baseCentre + 1;
  mesh.positions.push_back(base);
  mesh.positions.push_back(top);
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t next = (i + 1) % n;
    mesh.triangles.emplace_back(baseCentre, next, i);
    if (topRadius > 0.0) {
      addQuad(mesh, i, next, n + next, n + i);
      mesh.triangles.emplace_back(topCentre, n + i, n + next);
    } else {
      mesh.triangles.emplace_back(i, next, topCentre);
    }
  }
  return mesh;
}

Mesh tube(std::span<const glm::dvec3> points, std::span<const double> radii, int segments) {
  assert(segments >= 3 && points.size() >= 2 && points.size() == radii.size());
  Mesh mesh;
  const auto n = static_cast<uint32_t>(segments), rings = static_cast<uint32_t>(points.size());
  glm::dvec3 side(0.0);
  for (uint32_t ring = 0; ring < rings; ++ring) {
    const glm::dvec3 before = points[ring == 0 ? 0 : ring - 1], after = points[std::min(ring + 1, rings - 1)];
    const glm::dvec3 along = glm::normalize(after - before);
    // The last ring's side, made perpendicular again: corresponding vertices of neighbours stay neighbours.
    side = ring == 0 ? perpendicular(along) : glm::normalize(side - glm::dot(side, along) * along);
    const glm::dvec3 across = glm::cross(along, side);
    for (uint32_t i = 0; i < n; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / n;
      mesh.positions.push_back(points[ring] +
                               radii[ring] * (std::cos(angle) * side + std::sin(angle) * across));
    }
  }
  const uint32_t first = rings * n, last = first + 1, top = first - n;
  mesh.positions.push_back(points.front());
  mesh.positions.push_back(points.back());
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t next = (i + 1) % n;
    mesh.triangles.emplace_back(first, next, i);
    for (uint32_t ring = 0; ring + 1 < rings; ++ring)
      addQuad(mesh, ring * n + i, ring * n + next, (ring + 1) * n + next, (ring + 1) * n + i);
    mesh.triangles.emplace_back(last, top + i, top + next);
  }
  return mesh;
}

void append(Mesh& to, const Mesh& mesh) {
  const auto first = static_cast<uint32_t>(to.positions.size());
  to.positions.insert(to.positions.end(), mesh.positions.begin(), mesh.positions.end());
  for (const glm::uvec3& triangle : mesh.triangles) to.triangles.push_back(triangle + first);
  appendAttribute(to.normals, mesh.normals, first, to.positions.size());
  appendAttribute(to.attributes, mesh.attributes, first, to.positions.size());
  if (to.morphTargets.empty() && mesh.morphTargets.empty()) return;
  // A vertex without a morph target stays where it is.
  to.morphTargets.insert(to.morphTargets.end(),
                         to.positions.begin() + static_cast<ptrdiff_t>(to.morphTargets.size()),
                         to.positions.begin() + first);
  to.morphTargets.insert(to.morphTargets.end(), mesh.morphTargets.begin(), mesh.morphTargets.end());
  to.morphTargets.insert(to.morphTargets.end(),
                         to.positions.begin() + static_cast<ptrdiff_t>(to.morphTargets.size()),
                         to.positions.end());
}

glm::dvec3 perpendicular(glm::dvec3 direction) {
  const glm::dvec3 helper =
      std::abs(direction.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
  return glm::normalize(glm::cross(helper, direction));
}

glm::dvec3 Random::direction() {
  const double y = uniform(-1.0, 1.0), angle = uniform(0.0, 2.0 * std::numbers::pi),
               r = std::sqrt(1.0 - y * y);
  return {r * std::cos(angle), y, r * std::sin(angle)};
}

}  // namespace limen::scene
