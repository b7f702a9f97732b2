// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/polygon_mesh.h"

#include <algorithm>
#include <stdexcept>

namespace limen::surfaces {
namespace {

/// Of a face at one of its corners: the vertices after and before it.
struct Corner {
  uint32_t face, next, previous;
};

VertexRing ringOf(const std::vector<Corner>& corners, Fans fans) {
  VertexRing ring;
  if (corners.empty()) return ring;
  const auto startingAt = [&](uint32_t vertex) {
    return std::find_if(corners.begin(), corners.end(), [&](const Corner& c) { return c.next == vertex; });
  };
  const auto endingAt = [&](uint32_t vertex) {
    return std::find_if(corners.begin(), corners.end(),
                        [&](const Corner& c) { return c.previous == vertex; });
  };
  // An open ring begins with the edge that ends no face.
  auto at = std::find_if(corners.begin(), corners.end(),
                         [&](const Corner& c) { return endingAt(c.next) == corners.end(); });
  ring.closed = at == corners.end();
  if (ring.closed) at = corners.begin();
  while (at != corners.end() && ring.faces.size() < corners.size()) {
    ring.faces.push_back(at->face), ring.edges.push_back(at->next);
    const uint32_t previous = at->previous;
    at = startingAt(previous);
    if (at == corners.end()) ring.edges.push_back(previous);
  }
  if (ring.faces.size() == corners.size() && (!ring.closed || at == corners.begin())) return ring;
  if (fans == Fans::One) throw std::invalid_argument("the faces around a vertex form more than one fan");
  return {};
}

}  // namespace

MeshTopology::MeshTopology(const PolygonMesh& mesh, Fans fans) {
  std::vector<std::vector<Corner>> corners(mesh.points.size());
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<uint32_t>& face = mesh.faces[f];
    for (size_t i = 0; i < face.size(); ++i) {
      const uint32_t at = face[i], next = face[(i + 1) % face.size()],
                     previous = face[(i + face.size() - 1) % face.size()];
      corners.at(at).push_back({f, next, previous});
      auto& sides = edges_.try_emplace(edgeKey(at, next), std::array<int32_t, 2>{-1, -1}).first->second;
      int32_t& side = sides[at < next ? 0 : 1];
      if (side >= 0) throw std::invalid_argument("an edge has two faces on the same side");
      side = static_cast<int32_t>(f);
    }
  }
  for (const std::vector<Corner>& around : corners) rings_.push_back(ringOf(around, fans));
}

double MeshTopology::sharpness(const PolygonMesh& mesh, EdgeKey edge) const {
  const std::array<int32_t, 2>& sides = edges_.at(edge);
  if (sides[0] < 0 || sides[1] < 0) return kInfinitelySharp;
  const auto at = mesh.sharpness.find(edge);
  return at == mesh.sharpness.end() ? 0.0 : at->second;
}

PolygonMesh triangulated(PolygonMesh mesh) {
  std::vector<std::vector<uint32_t>> triangles;
  for (const std::vector<uint32_t>& f : mesh.faces)
    for (size_t i = 2; i < f.size(); ++i) triangles.push_back({f[0], f[i - 1], f[i]});
  mesh.faces = std::move(triangles);
  return mesh;
}

}  // namespace limen::surfaces
