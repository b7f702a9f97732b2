// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/table_layout.h"

#include <algorithm>

#include "experiments/base/error.h"

namespace limen::surfaces {
namespace {

Stencil composed(const Stencil& fine, const std::vector<Stencil>& coarse) {
  std::map<uint32_t, double> sum;
  for (const auto& [vertex, w] : fine)
    for (const auto& [from, share] : coarse[vertex]) sum[from] += w * share;
  return {sum.begin(), sum.end()};
}

/// Of each half-edge, the control at its start.
std::vector<uint32_t> makeControls(TableLayout& out, const HalfEdges& edges) {
  constexpr uint32_t kNone = HalfEdges::kNone;
  std::vector<uint32_t> controlAt(edges.from.size(), kNone);
  for (uint32_t v = 0; v < out.mesh.vertices; ++v) out.controls.push_back({v, {}, true});
  std::vector<char> taken(out.mesh.vertices);
  for (uint32_t h = 0; h < edges.from.size(); ++h) {
    if (controlAt[h] != kNone) continue;
    const uint32_t v = edges.from[h];
    size_t sharp = 0;
    for (const uint32_t end : edges.ring(v).ends) sharp += out.mesh.isSharp(v, end);
    const auto blocked = [&](uint32_t end) { return sharp >= 2 && out.mesh.isSharp(v, end); };
    uint32_t first = h;
    while (!blocked(edges.to(first)) && edges.twin[first] != kNone) {
      first = edges.next[edges.twin[first]];
      if (first == h) break;
    }
    TableControl control{v, {}, true};
    const auto number = taken[v] ? static_cast<uint32_t>(out.controls.size()) : v;
    for (uint32_t at = first;;) {
      controlAt[at] = number;
      control.fan.push_back(edges.to(at));
      const uint32_t end = edges.from[edges.previous[at]];
      const uint32_t on = blocked(end) ? kNone : edges.turned(at);
      if (on == first) break;
      if (on == kNone) {
        control.fan.push_back(end);
        control.closed = false;
        break;
      }
      at = on;
    }
    if (taken[v])
      out.controls.push_back(std::move(control));
    else
      out.controls[v] = std::move(control);
    taken[v] = 1;
  }
  return controlAt;
}

/// The same with a control for each value of the attributes, whose half-edges are numbered as the mesh's.
void divideByAttributes(TableLayout& out, std::vector<uint32_t>& controlAt, const HalfEdges& attributes) {
  std::map<std::array<uint32_t, 2>, uint32_t> known;
  std::vector<char> taken(out.controls.size());
  for (uint32_t h = 0; h < controlAt.size(); ++h) {
    const uint32_t control = controlAt[h];
    const auto [at, added] = known.emplace(std::array{control, attributes.from[h]}, control);
    if (added && taken[control]) {
      at->second = static_cast<uint32_t>(out.controls.size());
      out.controls.push_back(TableControl(out.controls[control]));
    }
    taken[control] = 1;
    controlAt[h] = at->second;
  }
}

/// Regular faces alone need no choice of their first corner; for all others the smallest key.
struct Canonical {
  Surroundings piece;
  std::vector<uint32_t> key;
  size_t rotation = 0;
};
Canonical canonical(const TableLayout& layout, const HalfEdges& edges, uint32_t face) {
  const size_t corners = layout.corners(), plain = corners == 3 ? 6 : 4;
  const int rings = ringsOf(layout.scheme);
  std::vector<size_t> rotations;
  for (size_t c = 0; c < corners; ++c) {
    const uint32_t v = layout.mesh.faces[face][c];
    const HalfEdges::Ring ring = edges.ring(v);
    const bool sharp = std::any_of(ring.ends.begin(), ring.ends.end(),
                                   [&](uint32_t end) { return layout.mesh.isSharp(v, end); });
    if (!ring.closed || ring.ends.size() != plain || sharp) rotations.push_back(c);
  }
  if (rotations.empty()) rotations.push_back(0);
  std::optional<Canonical> best;
  for (const size_t rotation : rotations) {
    Surroundings piece = surroundingsOf(layout.mesh, edges, face, rotation, rings);
    std::vector<uint32_t> key = keyOf(piece);
    if (!best || key < best->key) best.emplace(Canonical{std::move(piece), std::move(key), rotation});
  }
  return *best;
}

void requireSlots(const Surroundings& piece) {
  if (piece.mesh.vertices > kMostSlots)
    throw Error("a patch depends on " + std::to_string(piece.mesh.vertices) + " vertices", "",
                "tables take " + std::to_string(kMostSlots) + ": divide faces at vertices of many edges");
}

/// A mesh of values after the first steps; its half-edges are numbered as those of the refined mesh.
struct RefinedAttributes {
  RuleMesh mesh;
  std::vector<glm::dvec3> values;
  HalfEdges edges;

  RefinedAttributes(const PolygonMesh& given, SubdivisionScheme scheme, int steps)
      : mesh(ruleMesh(given, scheme)), values(given.points), edges(0, {}) {
    for (int step = 0; step < steps; ++step) {
      const SubdivisionStep once = refined(mesh, scheme);
      std::vector<glm::dvec3> finer;
      for (const auto& point : once.points) {
        glm::dvec3 sum(0.0);
        for (const auto& [from, weight] : *point) sum += weight * values[from];
        finer.push_back(sum);
      }
      values = std::move(finer);
      mesh = once.mesh;
    }
    edges = HalfEdges(mesh.vertices, mesh.faces);
  }
};

/// Who makes the vertices of sides and corners.
void shareOut(TableLayout& out, const HalfEdges& edges, const std::vector<uint32_t>& firstHalf,
              const HalfEdges* attributes) {
  const auto isSeam = [&](uint32_t h) {
    const uint32_t twin = edges.twin[h];
    return attributes && twin != HalfEdges::kNone && attributes->twin[h] != twin;
  };
  const auto k = static_cast<uint32_t>(out.corners());
  std::vector<uint32_t> sideAt(edges.from.size());  // 4 patch + side
  for (uint32_t p = 0; p < out.patches.size(); ++p) {
    uint32_t h = firstHalf[p];
    for (uint32_t s = 0; s < k; ++s, h = edges.next[h]) sideAt[h] = 4 * p + s;
  }
  std::vector<uint32_t> cornerSource(out.mesh.vertices, HalfEdges::kNone);
  std::vector<char> cornerWritten(out.controls.size());
  for (uint32_t p = 0; p < out.patches.size(); ++p) {
    TablePatch& patch = out.patches[p];
    uint32_t h = firstHalf[p];
    for (uint32_t s = 0; s < k; ++s, h = edges.next[h]) {
      const uint32_t twin = edges.twin[h], v = edges.from[h];
      const bool first = twin == HalfEdges::kNone || sideAt[h] < sideAt[twin];
      const bool split = out.mesh.isSharp(v, edges.to(h)) || isSeam(h);
      patch.edgeSources[s] = first ? 8 * p + 2 * s : 8 * (sideAt[twin] / 4) + 2 * (sideAt[twin] % 4) + 1;
      patch.writesEdge[s] = first || split;
      patch.edges[s] =
          first || split ? out.fineEdges++ : out.patches[sideAt[twin] / 4].edges[sideAt[twin] % 4];
      if (cornerSource[v] == HalfEdges::kNone) cornerSource[v] = 4 * p + s;
      patch.cornerSources[s] = cornerSource[v];
      patch.writesCorner[s] = cornerWritten[patch.controls[s]] == 0;
      cornerWritten[patch.controls[s]] = 1;
    }
  }
}

}  // namespace

int64_t TableLayout::tableBytes() const {
  int64_t out = 0;
  for (const BasisTable& table : tables) out += 4 * int64_t(table.weights.size());
  return out;
}

size_t TableLayout::mostSlots() const {
  size_t out = 0;
  for (const BasisTable& table : tables) out = std::max(out, table.slots);
  return out;
}

int64_t TableLayout::verticesAt(int level) const {
  const int64_t n = int64_t{1} << level, inside = corners() == 3 ? (n - 1) * (n - 2) / 2 : (n - 1) * (n - 1);
  return int64_t(controls.size()) + int64_t{fineEdges} * (n - 1) + int64_t(patches.size()) * inside;
}

int64_t TableLayout::trianglesAt(int level) const {
  return int64_t(patches.size()) * (corners() == 3 ? 1 : 2) << (2 * level);
}

TableLayout tableLayout(const PolygonMesh& mesh, SubdivisionScheme scheme, int tableLevel, int steps,
                        bool tangents, const PolygonMesh* attributes) {
  TableLayout out;
  out.scheme = scheme;
  out.steps = steps;
  out.tableLevel = tableLevel;
  out.mesh = ruleMesh(mesh, scheme);
  out.places = placesOf(out.corners(), tableLevel);
  for (uint32_t v = 0; v < out.mesh.vertices; ++v) out.entries.push_back({{v, 1.0}});
  std::vector<uint32_t> parents;
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) parents.push_back(f);
  for (int step = 0; step < steps; ++step) {
    std::vector<uint32_t> children;
    for (uint32_t f = 0; f < out.mesh.faces.size(); ++f) {
      const size_t k = out.mesh.faces[f].size();
      children.insert(children.end(), out.corners() == 3 ? k + 1 : k, parents[f]);
    }
    parents = std::move(children);
    const SubdivisionStep once = refined(out.mesh, scheme);
    std::vector<Stencil> entries;
    for (const auto& point : once.points) entries.push_back(composed(*point, out.entries));
    out.entries = std::move(entries);
    out.mesh = once.mesh;
  }
  if (!out.mesh.semiSharp.empty())
    throw Error("edges are semi-sharp for more than " + std::to_string(steps) + " steps", "",
                "tables start where edges are smooth, or sharp for ever");
  const HalfEdges edges(out.mesh.vertices, out.mesh.faces);
  std::vector<uint32_t> controlAt = makeControls(out, edges);
  std::optional<RefinedAttributes> refinedAttributes;
  if (attributes) {
    refinedAttributes.emplace(*attributes, scheme, steps);
    out.attributeControls = refinedAttributes->values;
    divideByAttributes(out, controlAt, refinedAttributes->edges);
  }
  std::map<std::vector<uint32_t>, uint32_t> known;
  struct Made {
    TablePatch patch;
    uint32_t firstHalf;
  };
  std::vector<Made> made;
  const auto tableOf = [&](const Surroundings& piece, std::vector<uint32_t> key, bool withTangents) {
    requireSlots(piece);
    const auto [at, added] = known.emplace(std::move(key), static_cast<uint32_t>(out.tables.size()));
    if (added) out.tables.push_back(basisTable(piece, scheme, tableLevel, withTangents));
    return at->second;
  };
  std::vector<size_t> rotations;
  for (uint32_t f = 0; f < out.mesh.faces.size(); ++f) {
    auto [piece, key, rotation] = canonical(out, edges, f);
    Made& one = made.emplace_back();
    one.firstHalf = piece.firstHalfEdge;
    one.patch.table = tableOf(piece, std::move(key), tangents);
    rotations.push_back(rotation);
    one.patch.parent = parents[f];
    for (const uint32_t h : piece.halfEdges) one.patch.controls.push_back(controlAt[h]);
  }
  if (refinedAttributes) {
    const RefinedAttributes& of = *refinedAttributes;
    for (uint32_t f = 0; f < made.size(); ++f) {
      const Surroundings own = surroundingsOf(of.mesh, of.edges, f, rotations[f], ringsOf(scheme));
      made[f].patch.attributeTable = tableOf(own, keyOf(own), false);
      for (const uint32_t h : own.halfEdges) made[f].patch.attributeControls.push_back(of.edges.from[h]);
    }
  }
  // Patches of one table in succession: their work groups read the same rows.
  std::stable_sort(made.begin(), made.end(),
                   [](const Made& a, const Made& b) { return a.patch.table < b.patch.table; });
  std::vector<uint32_t> firstHalf;
  for (Made& one : made) {
    out.patches.push_back(std::move(one.patch));
    firstHalf.push_back(one.firstHalf);
  }
  shareOut(out, edges, firstHalf, refinedAttributes ? &refinedAttributes->edges : nullptr);
  return out;
}

}  // namespace limen::surfaces
