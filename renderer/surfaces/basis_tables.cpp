// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/basis_tables.h"

#include <algorithm>
#include <cassert>

#include "experiments/base/error.h"

namespace limen::surfaces {
namespace {

/// Half-edges from the vertex of h whose faces lie in the same sector between sharp edges; all of a vertex
/// with fewer than two sharp edges.
std::vector<uint32_t> sectorOf(const RuleMesh& mesh, const HalfEdges& edges, uint32_t h) {
  const uint32_t v = edges.from[h];
  size_t sharp = 0;
  for (const uint32_t end : edges.ring(v).ends) sharp += mesh.isSharp(v, end);
  const bool divides = sharp >= 2;
  const auto blocked = [&](uint32_t other) { return divides && mesh.isSharp(v, other); };
  // Back to the sector's first face, then forward.
  uint32_t first = h;
  while (!blocked(edges.to(first)) && edges.twin[first] != HalfEdges::kNone) {
    first = edges.next[edges.twin[first]];
    if (first == h) break;
  }
  std::vector<uint32_t> out;
  for (uint32_t at = first;;) {
    out.push_back(at);
    if (blocked(edges.from[edges.previous[at]])) break;
    at = edges.turned(at);
    if (at == HalfEdges::kNone || at == first) break;
  }
  return out;
}

/// A piece while it is refined: the region that becomes the patch, and enough around it.
struct Refining {
  RuleMesh mesh;
  std::vector<std::vector<double>> weights;  ///< by vertex, over the piece's slots
  std::vector<std::optional<Place>> places;  ///< of the region's vertices
  std::vector<char> ofRegion;                ///< by face
};

Place plus(const Place& a, const Place& b) { return {a[0] + b[0], a[1] + b[1]}; }

/// Keeps faces within `rings` of the region, of known points alone.
Refining pruned(const Refining& fine, const std::vector<char>& known, int rings) {
  std::vector<char> near(fine.mesh.vertices), taken(fine.mesh.faces.size());
  for (size_t v = 0; v < near.size(); ++v) near[v] = fine.places[v].has_value();
  const auto touches = [&](const std::vector<uint32_t>& face) {
    return std::any_of(face.begin(), face.end(), [&](uint32_t v) { return near[v] != 0; });
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (size_t f = 0; f < taken.size(); ++f) taken[f] = char(touches(fine.mesh.faces[f]));
    for (size_t f = 0; f < taken.size(); ++f)
      if (taken[f])
        for (const uint32_t v : fine.mesh.faces[f]) near[v] = 1;
  }
  constexpr uint32_t kNowhere = 0xffffffffU;
  std::vector<uint32_t> number(fine.mesh.vertices, kNowhere);
  Refining out;
  for (size_t f = 0; f < taken.size(); ++f) {
    std::vector<uint32_t> face = fine.mesh.faces[f];
    if (!taken[f] || !std::all_of(face.begin(), face.end(), [&](uint32_t v) { return known[v] != 0; }))
      continue;
    for (uint32_t& v : face) {
      if (number[v] == kNowhere) {
        number[v] = static_cast<uint32_t>(out.weights.size());
        out.weights.push_back(fine.weights[v]);
        out.places.push_back(fine.places[v]);
        if (fine.mesh.corners.contains(v)) out.mesh.corners.insert(number[v]);
      }
      v = number[v];
    }
    out.mesh.faces.push_back(std::move(face));
    out.ofRegion.push_back(fine.ofRegion[f]);
  }
  out.mesh.vertices = out.weights.size();
  for (const EdgeKey& edge : fine.mesh.sharp)
    if (number[edge[0]] != kNowhere && number[edge[1]] != kNowhere)
      out.mesh.sharp.insert(edgeKey(number[edge[0]], number[edge[1]]));
  return out;
}

std::vector<double> combined(const Stencil& stencil, const std::vector<std::vector<double>>& weights) {
  std::vector<double> out(weights.front().size());
  for (const auto& [vertex, w] : stencil)
    for (size_t s = 0; s < out.size(); ++s) out[s] += w * weights[vertex][s];
  return out;
}

Refining refinedOnce(const Refining& coarse, SubdivisionScheme scheme) {
  const SubdivisionStep step = refined(coarse.mesh, scheme);
  Refining fine;
  fine.mesh = step.mesh;
  fine.places.resize(step.points.size());
  std::vector<char> known;
  for (const auto& stencil : step.points) {
    known.push_back(char(stencil.has_value()));
    fine.weights.push_back(stencil ? combined(*stencil, coarse.weights) : std::vector<double>());
  }
  const bool quads = scheme == SubdivisionScheme::CatmullClark;
  for (uint32_t f = 0; f < coarse.mesh.faces.size(); ++f) {
    const std::vector<uint32_t>& face = coarse.mesh.faces[f];
    const size_t k = face.size();
    fine.ofRegion.insert(fine.ofRegion.end(), quads ? k : k + 1, coarse.ofRegion[f]);
    if (!coarse.ofRegion[f]) continue;
    for (size_t i = 0; i < k; ++i) {
      const Place &a = *coarse.places[face[i]], &b = *coarse.places[face[(i + 1) % k]];
      fine.places[face[i]] = plus(a, a);
      fine.places[step.edgePoints.at(edgeKey(face[i], face[(i + 1) % k]))] = plus(a, b);
      if (quads && i == 0) fine.places[step.firstFacePoint + f] = plus(a, *coarse.places[face[2]]);
    }
  }
  return pruned(fine, known, ringsOf(scheme));
}

}  // namespace

std::vector<Place> placesOf(size_t corners, int level) {
  std::vector<Place> out;
  for (int l = 0; l <= level; ++l) {
    const int n = 1 << l, scale = 1 << (level - l);
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= (corners == 3 ? n - y : n); ++x)
        if (l == 0 || x % 2 != 0 || y % 2 != 0) out.push_back({x * scale, y * scale});
  }
  return out;
}

Surroundings surroundingsOf(const RuleMesh& mesh, const HalfEdges& edges, uint32_t face, size_t rotation,
                            int rings) {
  std::set<uint32_t> faces = {face};
  std::vector<uint32_t> outer = {face};
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<uint32_t> found;
    for (const uint32_t f : outer)
      for (uint32_t i = 0; i < mesh.faces[f].size(); ++i)
        for (const uint32_t h : sectorOf(mesh, edges, edges.firstOf[f] + i))
          if (faces.insert(edges.face[h]).second) found.push_back(edges.face[h]);
    outer = std::move(found);
  }
  Surroundings out;
  out.firstHalfEdge = edges.firstOf[face] + static_cast<uint32_t>(rotation);
  std::map<uint32_t, uint32_t> number;
  std::vector<uint32_t> entries = {out.firstHalfEdge};
  std::set<uint32_t> visited = {face};
  for (size_t at = 0; at < entries.size(); ++at) {
    std::vector<uint32_t> corners;
    uint32_t h = entries[at];
    do {
      const auto [place, added] = number.emplace(edges.from[h], static_cast<uint32_t>(number.size()));
      if (added) out.halfEdges.push_back(h);
      corners.push_back(place->second);
      const uint32_t twin = edges.twin[h];
      if (twin != HalfEdges::kNone && faces.contains(edges.face[twin]) &&
          visited.insert(edges.face[twin]).second)
        entries.push_back(twin);
      h = edges.next[h];
    } while (h != entries[at]);
    out.mesh.faces.push_back(std::move(corners));
  }
  out.mesh.vertices = number.size();
  // What is sharp beyond the face's own corners does not matter.
  const auto corners = static_cast<uint32_t>(mesh.faces[face].size());
  for (const uint32_t entry : entries)
    for (uint32_t h = entry;;) {
      const uint32_t a = edges.from[h], b = edges.to(h);
      const uint32_t from = number.at(a), to = number.at(b);
      if (mesh.isSharp(a, b) && std::min(from, to) < corners) out.mesh.sharp.insert(edgeKey(from, to));
      if (mesh.corners.contains(a) && from < corners) out.mesh.corners.insert(from);
      h = edges.next[h];
      if (h == entry) break;
    }
  return out;
}

std::vector<uint32_t> keyOf(const Surroundings& piece) {
  std::vector<uint32_t> key;
  for (const std::vector<uint32_t>& face : piece.mesh.faces) {
    key.push_back(static_cast<uint32_t>(face.size()));
    key.insert(key.end(), face.begin(), face.end());
  }
  for (const EdgeKey& edge : piece.mesh.sharp) key.insert(key.end(), {0xfffffffeU, edge[0], edge[1]});
  for (const uint32_t v : piece.mesh.corners) key.insert(key.end(), {0xffffffffU, v});
  return key;
}

BasisTable basisTable(const Surroundings& piece, SubdivisionScheme scheme, int level, bool tangents) {
  const size_t corners = cornersOf(scheme), slots = piece.mesh.vertices;
  assert(piece.mesh.faces.front().size() == corners);
  Refining now;
  now.mesh = piece.mesh;
  now.places.resize(slots);
  now.ofRegion.assign(piece.mesh.faces.size(), 0);
  now.ofRegion[0] = 1;
  const std::array<Place, 4> unit = {Place{0, 0}, {1, 0}, corners == 3 ? Place{0, 1} : Place{1, 1}, {0, 1}};
  for (size_t c = 0; c < corners; ++c) now.places[c] = unit[c];
  for (size_t s = 0; s < slots; ++s) {
    now.weights.emplace_back(slots, 0.0);
    now.weights.back()[s] = 1.0;
  }
  for (int l = 0; l < level; ++l) now = refinedOnce(now, scheme);
  const std::vector<Place> places = placesOf(corners, level);
  std::map<Place, size_t> rowOf;
  for (size_t row = 0; row < places.size(); ++row) rowOf[places[row]] = row;
  BasisTable out;
  out.slots = slots;
  out.weights.assign(slots * places.size(), 0.0);
  if (tangents)
    for (auto& tangent : out.tangents) tangent = out.weights;
  const HalfEdges edges(now.mesh.vertices, now.mesh.faces);
  size_t found = 0;
  for (uint32_t v = 0; v < now.mesh.vertices; ++v) {
    if (!now.places[v]) continue;
    const size_t row = rowOf.at(*now.places[v]);
    const auto stencil = limitStencil(now.mesh, edges, scheme, v);
    if (!stencil) throw Error("a vertex of a patch has no complete surroundings", "", "report this mesh");
    ++found;
    const auto store = [&](const Stencil& of, std::vector<double>& to) {
      const std::vector<double> weights = combined(of, now.weights);
      for (size_t s = 0; s < slots; ++s) to[s * places.size() + row] = weights[s];
    };
    store(*stencil, out.weights);
    if (!tangents) continue;
    const auto both = loopTangents(now.mesh, edges, v);
    if (!both) throw Error("a corner of several faces has no tangents", "", "use normals of the first step");
    for (size_t t = 0; t < 2; ++t) store((*both)[t], out.tangents[t]);
  }
  if (found != places.size())
    throw Error("a patch has " + std::to_string(found) + " places of " + std::to_string(places.size()));
  return out;
}

}  // namespace limen::surfaces
