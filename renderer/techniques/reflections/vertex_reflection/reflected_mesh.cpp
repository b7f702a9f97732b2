// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/vertex_reflection/reflected_mesh.h"

#include <map>
#include <utility>

#include "experiments/base/error.h"

namespace limen::reflections {
namespace {

constexpr uint32_t kUnplaced = 0xffffffffU;
constexpr size_t kMostTriangles = size_t{1} << 24;

class Divider {
 public:
  Divider(const scene::Mesh& mesh, int segments, glm::dvec3 anchor)
      : mesh_(mesh), n_(segments), anchor_(anchor) {
    corners_.assign(mesh.positions.size(), kUnplaced);
    out_.perTriangle = segments * segments;
  }

  ReflectedMesh all() {
    for (uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      out_.firstVertices.push_back(static_cast<uint32_t>(out_.positions.size()));
      divide(i);
    }
    out_.firstVertices.push_back(static_cast<uint32_t>(out_.positions.size()));
    return std::move(out_);
  }

 private:
  void divide(uint32_t source) {
    const glm::uvec3& corners = mesh_.triangles[source];
    // Row j from corner x, position i along it: weights (n - j, j - i, i) over n.
    std::vector<uint32_t> grid;
    for (int j = 0; j <= n_; ++j)
      for (int i = 0; i <= j; ++i) grid.push_back(vertex(corners, {n_ - j, j - i, i}));
    const auto at = [&](int j, int i) { return grid[static_cast<size_t>(j * (j + 1) / 2 + i)]; };
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i <= j; ++i) {
        add({at(j, i), at(j + 1, i), at(j + 1, i + 1)}, source);
        if (i < j) add({at(j, i), at(j + 1, i + 1), at(j, i + 1)}, source);
      }
  }

  void add(glm::uvec3 triangle, uint32_t source) {
    out_.triangles.push_back(triangle);
    out_.sources.push_back(source);
  }

  uint32_t vertex(const glm::uvec3& corners, glm::ivec3 weights) {
    for (int k = 0; k < 3; ++k)
      if (weights[k] == n_) {
        uint32_t& known = corners_[corners[k]];
        if (known == kUnplaced) known = place(mesh_.positions[corners[k]]);
        return known;
      }
    for (int k = 0; k < 3; ++k)
      if (weights[k] == 0) {
        uint32_t from = corners[(k + 1) % 3], to = corners[(k + 2) % 3];
        int along = weights[(k + 2) % 3];
        if (from > to) std::swap(from, to), along = n_ - along;
        std::vector<uint32_t>& edge = edges_[{from, to}];
        if (edge.empty()) edge.assign(static_cast<size_t>(n_), kUnplaced);
        uint32_t& known = edge[static_cast<size_t>(along)];
        if (known == kUnplaced) {
          const double t = double(along) / n_;
          known = place((1.0 - t) * mesh_.positions[from] + t * mesh_.positions[to]);
        }
        return known;
      }
    const glm::dvec3 w = glm::dvec3(weights) / double(n_);
    return place(w.x * mesh_.positions[corners.x] + w.y * mesh_.positions[corners.y] +
                 w.z * mesh_.positions[corners.z]);
  }

  uint32_t place(glm::dvec3 position) {
    out_.positions.emplace_back(position - anchor_);
    return static_cast<uint32_t>(out_.positions.size() - 1);
  }

  const scene::Mesh& mesh_;
  int n_;
  glm::dvec3 anchor_;
  ReflectedMesh out_;
  std::vector<uint32_t> corners_;  // by vertex of the scene
  std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> edges_;
};

}  // namespace

ReflectedMesh::Range ReflectedMesh::ownVertices(uint32_t firstTriangle, uint32_t triangleCount) const {
  const Range own{firstVertices[firstTriangle],
                  firstVertices[firstTriangle + triangleCount] - firstVertices[firstTriangle]};
  const size_t end = size_t{firstTriangle + triangleCount} * static_cast<size_t>(perTriangle);
  for (size_t i = end; i < triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (triangles[i][k] >= own.first && triangles[i][k] - own.first < own.count) return {};
  return own;
}

ReflectedMesh divided(const scene::Mesh& mesh, int segments, glm::dvec3 anchor) {
  const size_t triangles = mesh.triangles.size() * static_cast<size_t>(segments) * segments;
  if (triangles > kMostTriangles)
    throw Error("the reflected scene would have " + std::to_string(triangles) + " triangles", "segments",
                "choose fewer segments: at most " + std::to_string(kMostTriangles) + " triangles are made");
  return Divider(mesh, segments, anchor).all();
}

}  // namespace limen::reflections
