// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/curved/double_torus.h"

#include <cmath>

#include "renderer/surfaces/catmull_clark.h"

namespace limen::scene {
namespace {

constexpr uint32_t kAround = 5;
constexpr double kMajor = 1.0, kMinor = 0.45;

/// Vertex (a, b) of a ring: a around the y axis, b around the tube; both begin half a segment before the +x
/// direction, so that quad (0, 0) faces it. Its corners lie in the plane x = 0 after the shift.
glm::dvec3 ringPoint(uint32_t a, uint32_t b) {
  const double step = 2.0 * M_PI / kAround, major = step * (a - 0.5), minor = step * (b - 0.5);
  const double radius = kMajor + kMinor * std::cos(minor);
  const double plane = (kMajor + kMinor * std::cos(0.5 * step)) * std::cos(0.5 * step);
  return {radius * std::cos(major) - plane, kMinor * std::sin(minor), -radius * std::sin(major)};
}

bool isShared(uint32_t a, uint32_t b) { return a < 2 && b < 2; }

}  // namespace

surfaces::PolygonMesh doubleTorusCage() {
  surfaces::PolygonMesh cage;
  // Index of vertex (a, b) of the left ring and of its mirror image.
  std::array<std::array<std::array<uint32_t, kAround>, kAround>, 2> index{};
  for (size_t side = 0; side < 2; ++side)
    for (uint32_t a = 0; a < kAround; ++a)
      for (uint32_t b = 0; b < kAround; ++b) {
        glm::dvec3 p = ringPoint(a, b);
        if (isShared(a, b)) p.x = 0.0;
        if (side == 1 && isShared(a, b)) {
          index[1][a][b] = index[0][a][b];
          continue;
        }
        index[side][a][b] = static_cast<uint32_t>(cage.points.size());
        cage.points.push_back(side == 0 ? p : glm::dvec3(-p.x, p.y, p.z));
      }
  for (size_t side = 0; side < 2; ++side)
    for (uint32_t a = 0; a < kAround; ++a)
      for (uint32_t b = 0; b < kAround; ++b) {
        if (a == 0 && b == 0) continue;
        const uint32_t c = (a + 1) % kAround, d = (b + 1) % kAround;
        const auto& at = index[side];
        if (side == 0)
          cage.faces.push_back({at[a][b], at[c][b], at[c][d], at[a][d]});
        else
          cage.faces.push_back({at[a][b], at[a][d], at[c][d], at[c][b]});
      }
  return cage;
}

surfaces::BaseMesh doubleTorus() {
  const surfaces::PolygonMesh fine = surfaces::catmullClark(doubleTorusCage(), 2);
  const surfaces::LimitPoints limit = surfaces::catmullClarkLimit(fine);
  surfaces::BaseMesh mesh;
  mesh.positions = limit.points;
  for (size_t f = 0; f < fine.faces.size(); ++f) {
    const std::vector<uint32_t>& q = fine.faces[f];
    const auto& n = limit.normals[f];
    mesh.triangles.insert(mesh.triangles.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});
    mesh.cornerNormals.insert(mesh.cornerNormals.end(), {{n[0], n[1], n[2]}, {n[0], n[2], n[3]}});
  }
  return mesh;
}

}  // namespace limen::scene
