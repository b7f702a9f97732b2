// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/catmull_clark_masks.h"

#include <algorithm>

#include "renderer/surfaces/catmull_clark_point.h"

namespace limen::surfaces {
namespace {

/// The face and all that touch it, with vertices and faces in an order that depends on their connections
/// alone.
PolygonMesh orderedSurroundings(const PolygonMesh& mesh, const MeshTopology& topology, uint32_t face) {
  PolygonMesh out;
  std::map<uint32_t, uint32_t> places;
  std::vector<uint32_t> added;
  const auto add = [&](uint32_t f, size_t first) {
    if (std::find(added.begin(), added.end(), f) != added.end()) return;
    added.push_back(f);
    const std::vector<uint32_t>& corners = mesh.faces[f];
    std::vector<uint32_t> moved;
    for (size_t c = 0; c < corners.size(); ++c) {
      const uint32_t v = corners[(first + c) % corners.size()];
      const auto [at, isNew] = places.try_emplace(v, static_cast<uint32_t>(out.points.size()));
      if (isNew) out.points.push_back(mesh.points[v]);
      moved.push_back(at->second);
    }
    out.faces.push_back(std::move(moved));
  };
  add(face, 0);
  for (const uint32_t corner : mesh.faces[face]) {
    const std::vector<uint32_t>& ring = topology.rings()[corner].faces;
    const auto own = static_cast<size_t>(std::find(ring.begin(), ring.end(), face) - ring.begin());
    for (size_t i = 1; i < ring.size(); ++i) {
      const uint32_t f = ring[(own + i) % ring.size()];
      const std::vector<uint32_t>& corners = mesh.faces[f];
      add(f, static_cast<size_t>(std::find(corners.begin(), corners.end(), corner) - corners.begin()));
    }
  }
  for (const auto& [edge, sharpness] : mesh.sharpness) {
    const auto a = places.find(edge[0]), b = places.find(edge[1]);
    if (a != places.end() && b != places.end()) out.sharpness[edgeKey(a->second, b->second)] = sharpness;
  }
  return out;
}

std::vector<double> keyOf(const PolygonMesh& around) {
  std::vector<double> key;
  for (const std::vector<uint32_t>& face : around.faces) key.insert(key.end(), face.begin(), face.end());
  for (const auto& [edge, sharpness] : around.sharpness)
    key.insert(key.end(), {-1.0, double(edge[0]), double(edge[1]), sharpness});
  return key;
}

}  // namespace

glm::dvec3 vertexAfterSteps(int steps, int valence, glm::dvec3 vertex, glm::dvec3 acrossEdges,
                            glm::dvec3 acrossFaces) {
  // One step takes the three to themselves: Schwarz 2009, Figure 6.8, averaged around the vertex.
  const double beta = 1.5 / valence, gamma = 0.25 / valence;
  for (int step = 0; step < steps; ++step) {
    const glm::dvec3 face = (vertex + 2.0 * acrossEdges + acrossFaces) / 4.0;
    const glm::dvec3 edge = (vertex + acrossEdges) / 4.0 + face / 2.0;
    vertex = (1.0 - beta - gamma) * vertex + beta * acrossEdges + gamma * acrossFaces;
    acrossEdges = edge, acrossFaces = face;
  }
  return vertex;
}

CatmullClarkMasks::Weights CatmullClarkMasks::weightsOf(PolygonMesh around) const {
  const size_t count = around.points.size(), side = static_cast<size_t>(segments_) + 1;
  Weights out(side * side, std::vector<double>(count));
  // Three vertices at a time: each coordinate of the surface's point is the weight of one.
  for (size_t first = 0; first < count; first += 3) {
    std::fill(around.points.begin(), around.points.end(), glm::dvec3(0.0));
    for (size_t k = 0; k < 3 && first + k < count; ++k) around.points[first + k][static_cast<int>(k)] = 1.0;
    for (size_t sample = 0; sample < out.size(); ++sample) {
      const glm::dvec3 weights =
          catmullClarkPoint(around, 0, double(sample % side) / segments_, double(sample / side) / segments_)
              .position;
      for (size_t k = 0; k < 3 && first + k < count; ++k)
        out[sample][first + k] = weights[static_cast<int>(k)];
    }
  }
  return out;
}

std::vector<glm::dvec3> CatmullClarkMasks::grid(const PolygonMesh& mesh, const MeshTopology& topology,
                                                uint32_t face) {
  const PolygonMesh around = orderedSurroundings(mesh, topology, face);
  const std::vector<double> key = keyOf(around);
  auto found = tables_.find(key);
  if (found == tables_.end()) found = tables_.emplace(key, weightsOf(around)).first;
  std::vector<glm::dvec3> out;
  for (const std::vector<double>& weights : found->second) {
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < weights.size(); ++i) sum += weights[i] * around.points[i];
    out.push_back(sum);
  }
  return out;
}

}  // namespace limen::surfaces
