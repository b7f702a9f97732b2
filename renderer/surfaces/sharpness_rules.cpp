// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/sharpness_rules.h"

namespace limen::surfaces {

std::vector<uint32_t> sharpEnds(const PolygonMesh& mesh, const MeshTopology& topology, uint32_t vertex,
                                bool next) {
  std::vector<uint32_t> out;
  for (const uint32_t end : topology.rings()[vertex].edges) {
    const double s = topology.sharpness(mesh, edgeKey(vertex, end));
    if ((next ? nextSharpness(s) : s) > 0.0) out.push_back(end);
  }
  return out;
}

std::vector<std::vector<size_t>> sectorsOf(const VertexRing& ring, const std::vector<uint32_t>& sharp) {
  const size_t n = ring.faces.size();
  const bool smooth = sharp.size() < 2;
  const auto isSharp = [&](size_t edge) {
    return std::find(sharp.begin(), sharp.end(), ring.edges[edge % ring.edges.size()]) != sharp.end();
  };
  size_t start = 0;
  if (!smooth && ring.closed)
    while (!isSharp(start)) ++start;
  std::vector<std::vector<size_t>> out;
  for (size_t i = 0; i < n; ++i) {
    const size_t place = (start + i) % n;
    if (i == 0 || (!smooth && isSharp(place))) out.emplace_back();
    out.back().push_back(place);
  }
  return out;
}

PolygonMesh surroundings(const PolygonMesh& mesh, uint32_t face) {
  const std::vector<uint32_t>& own = mesh.faces[face];
  PolygonMesh out;
  std::map<uint32_t, uint32_t> places;
  const auto add = [&](const std::vector<uint32_t>& corners) {
    std::vector<uint32_t> moved;
    for (const uint32_t v : corners) {
      const auto [at, isNew] = places.try_emplace(v, static_cast<uint32_t>(out.points.size()));
      if (isNew) out.points.push_back(mesh.points[v]);
      moved.push_back(at->second);
    }
    out.faces.push_back(std::move(moved));
  };
  add(own);
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<uint32_t>& corners = mesh.faces[f];
    if (f != face &&
        std::find_first_of(corners.begin(), corners.end(), own.begin(), own.end()) != corners.end())
      add(corners);
  }
  for (const auto& [edge, s] : mesh.sharpness) {
    const auto a = places.find(edge[0]), b = places.find(edge[1]);
    if (a != places.end() && b != places.end()) out.sharpness[edgeKey(a->second, b->second)] = s;
  }
  return out;
}

}  // namespace limen::surfaces
