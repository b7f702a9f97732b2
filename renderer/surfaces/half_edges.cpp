// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/half_edges.h"

#include <algorithm>
#include <set>

namespace limen::surfaces {
namespace {

std::string name(const char* kind, size_t at) { return std::string(kind) + " " + std::to_string(at); }
std::string name(EdgeKey edge) { return "edge " + std::to_string(edge[0]) + "-" + std::to_string(edge[1]); }

using EdgeFaces = std::map<EdgeKey, std::vector<uint32_t>>;

/// How many groups the faces around a vertex form that are connected by edges at the vertex.
size_t fansAround(const std::vector<uint32_t>& around, uint32_t vertex,
                  const std::vector<std::vector<uint32_t>>& faces, const EdgeFaces& edges) {
  std::set<uint32_t> left(around.begin(), around.end());
  size_t fans = 0;
  while (!left.empty()) {
    ++fans;
    std::vector<uint32_t> open = {*left.begin()};
    left.erase(left.begin());
    while (!open.empty()) {
      const std::vector<uint32_t>& face = faces[open.back()];
      open.pop_back();
      for (size_t i = 0; i < face.size(); ++i) {
        const uint32_t a = face[i], b = face[(i + 1) % face.size()];
        if (a != vertex && b != vertex) continue;
        for (const uint32_t other : edges.at(edgeKey(a, b)))
          if (left.erase(other) > 0) open.push_back(other);
      }
    }
  }
  return fans;
}

}  // namespace

std::optional<MeshFaultFound> findFault(size_t vertices, const std::vector<std::vector<uint32_t>>& faces) {
  EdgeFaces edges;
  std::set<std::array<uint32_t, 2>> directed;
  std::optional<MeshFaultFound> opposed;
  std::vector<std::vector<uint32_t>> around(vertices);
  for (uint32_t f = 0; f < faces.size(); ++f) {
    const std::vector<uint32_t>& face = faces[f];
    if (face.size() < 3 || std::set<uint32_t>(face.begin(), face.end()).size() < face.size())
      return {{MeshFault::RepeatedVertex, name("face", f) + " has a vertex twice, or fewer than three"}};
    for (size_t i = 0; i < face.size(); ++i) {
      const uint32_t a = face[i], b = face[(i + 1) % face.size()];
      if (a >= vertices)
        return {{MeshFault::UnknownVertex,
                 name("face", f) + " has " + name("vertex", a) + ", which the mesh does not have"}};
      edges[edgeKey(a, b)].push_back(f);
      around[a].push_back(f);
      if (!directed.insert({a, b}).second && !opposed)
        opposed = {MeshFault::OpposedFaces, "two faces run along " + name(edgeKey(a, b)) +
                                                " in the same direction; turn one of them over"};
    }
  }
  std::vector<uint32_t> boundary(vertices);
  for (const auto& [edge, along] : edges) {
    if (along.size() > 2)
      return {{MeshFault::CrowdedEdge, name(edge) + " has " + std::to_string(along.size()) + " faces"}};
    if (along.size() == 1) ++boundary[edge[0]], ++boundary[edge[1]];
  }
  for (uint32_t v = 0; v < vertices; ++v)
    if (boundary[v] != 0 && boundary[v] != 2)
      return {{MeshFault::CrowdedBoundary,
               name("vertex", v) + " has " + std::to_string(boundary[v]) + " boundary edges"}};
  for (uint32_t v = 0; v < vertices; ++v)
    if (fansAround(around[v], v, faces, edges) > 1)
      return {{MeshFault::SeveralFans, "the faces around " + name("vertex", v) + " form several fans"}};
  return opposed;
}

HalfEdges::HalfEdges(size_t vertices, const std::vector<std::vector<uint32_t>>& faces)
    : outgoing(vertices, kNone) {
  std::map<std::array<uint32_t, 2>, uint32_t> at;
  for (uint32_t f = 0; f < faces.size(); ++f) {
    const auto first = static_cast<uint32_t>(from.size()), count = static_cast<uint32_t>(faces[f].size());
    firstOf.push_back(first);
    for (uint32_t i = 0; i < count; ++i) {
      from.push_back(faces[f][i]);
      next.push_back(first + (i + 1) % count);
      previous.push_back(first + (i + count - 1) % count);
      face.push_back(f);
      at[{faces[f][i], faces[f][(i + 1) % count]}] = first + i;
    }
  }
  twin.assign(from.size(), kNone);
  for (uint32_t h = 0; h < from.size(); ++h) {
    const auto other = at.find({to(h), from[h]});
    if (other != at.end()) twin[h] = other->second;
  }
  for (uint32_t h = 0; h < from.size(); ++h)
    if (outgoing[from[h]] == kNone || twin[h] == kNone) outgoing[from[h]] = h;
}

HalfEdges::Ring HalfEdges::ring(uint32_t vertex) const {
  Ring out;
  const uint32_t start = outgoing[vertex];
  if (start == kNone) return out;
  for (uint32_t h = start;;) {
    out.ends.push_back(to(h));
    const uint32_t on = turned(h);
    if (on == start) return out;
    if (on == kNone) {
      out.ends.push_back(from[previous[h]]);
      out.closed = false;
      return out;
    }
    h = on;
  }
}

}  // namespace limen::surfaces
