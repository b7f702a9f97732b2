// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/subdivision/table_records.h"

namespace limen::techniques {
namespace {

constexpr uint32_t kClosedFan = 0x80000000U;

void addFan(EntryRecords& out, ControlEntry& entry, const std::vector<uint32_t>& fan, bool closed) {
  entry.firstAround = static_cast<uint32_t>(out.fans.size());
  entry.around = static_cast<uint32_t>(fan.size()) | (closed ? kClosedFan : 0U);
  out.fans.insert(out.fans.end(), fan.begin(), fan.end());
}

}  // namespace

std::vector<CageVertex> cageRecords(const surfaces::SubdivisionSurface& surface, glm::dvec3 anchor) {
  std::vector<CageVertex> out;
  for (size_t v = 0; v < surface.cage.points.size(); ++v) {
    CageVertex& vertex = out.emplace_back();
    vertex.rest = glm::vec3(surface.cage.points[v] - anchor);
    if (v >= surface.bindings.size()) continue;
    vertex.joint = surface.bindings[v].joint;
    vertex.weight = surface.bindings[v].weight;
  }
  return out;
}

EntryRecords entryRecords(const surfaces::TableLayout& layout) {
  EntryRecords out;
  for (const surfaces::TableControl& control : layout.controls) {
    ControlEntry entry{static_cast<uint32_t>(out.terms.size()), 0, 0, 0};
    for (const auto& [vertex, weight] : layout.entries[control.vertex])
      out.terms.push_back({vertex, static_cast<float>(weight)});
    entry.terms = static_cast<uint32_t>(out.terms.size()) - entry.firstTerm;
    addFan(out, entry, control.fan, control.closed);
    out.entries.push_back(entry);
  }
  return out;
}

EntryRecords cageFanRecords(const surfaces::PolygonMesh& cage) {
  EntryRecords out;
  const surfaces::HalfEdges edges(cage.points.size(), cage.faces);
  for (uint32_t v = 0; v < cage.points.size(); ++v) {
    ControlEntry entry{};
    const auto ring = edges.ring(v);
    addFan(out, entry, ring.ends, ring.closed);
    out.entries.push_back(entry);
  }
  return out;
}

PatchRecords patchRecords(const surfaces::TableLayout& layout, uint32_t material) {
  std::vector<uint32_t> firstWeights;
  uint32_t weights = 0;
  for (const surfaces::BasisTable& table : layout.tables) {
    firstWeights.push_back(weights);
    weights += static_cast<uint32_t>(table.weights.size());
  }
  PatchRecords out;
  for (const surfaces::TablePatch& patch : layout.patches) {
    SubdivisionPatch record{};
    record.firstPoint = static_cast<uint32_t>(out.points.size());
    record.points = static_cast<uint32_t>(patch.controls.size());
    record.firstWeight = firstWeights[patch.table];
    record.material = material;
    out.points.insert(out.points.end(), patch.controls.begin(), patch.controls.end());
    for (uint32_t s = 0; s < layout.corners(); ++s) {
      const auto i = static_cast<glm::length_t>(s);
      record.corners[i] = patch.controls[s];
      record.edges[i] = patch.edges[s];
      record.edgeSources[i] = patch.edgeSources[s];
      record.cornerSources[i] = patch.cornerSources[s];
      if (patch.writesEdge[s]) record.writes |= 1U << s;
      if (patch.writesCorner[s]) record.writes |= 16U << s;
      if (!patch.writesEdge[s]) record.writes |= 256U << s;
    }
    out.patches.push_back(record);
  }
  return out;
}

std::vector<float> tableWeights(const surfaces::TableLayout& layout) {
  std::vector<float> out;
  for (const surfaces::BasisTable& table : layout.tables)
    out.insert(out.end(), table.weights.begin(), table.weights.end());
  for (size_t t = 0; t < 2; ++t)
    for (const surfaces::BasisTable& table :
         layout.tables)  // those of attributes alone come last and have none
      out.insert(out.end(), table.tangents[t].begin(), table.tangents[t].end());
  return out;
}

namespace {

/// Rows of tables in the order of MeshPatch; kNoRow where rows are filled up.
constexpr uint32_t kNoRow = 0xffffffffU;
std::vector<uint32_t> meshRows(const surfaces::TableLayout& layout, MeshRecords& out) {
  const int n = 1 << layout.tableLevel;
  std::map<surfaces::Place, uint32_t> rowOf;
  for (uint32_t row = 0; row < layout.places.size(); ++row) rowOf[layout.places[row]] = row;
  std::vector<uint32_t> rows;
  const bool triangle = layout.corners() == 3;
  std::vector<uint32_t> inner;
  for (int y = 1; y < n; ++y)
    for (int x = 1; x < (triangle ? n - y : n); ++x) inner.push_back(rowOf.at({x, y}));
  out.innerRows = static_cast<uint32_t>(inner.size());
  constexpr size_t kLanes = kMeshLanes;
  out.rowsEach = inner.size() <= kLanes ? 1 : inner.size() <= 2 * kLanes ? 2 : 4;
  for (size_t first = 0; first < inner.size(); first += kLanes * out.rowsEach)
    for (size_t lane = 0; lane < kLanes; ++lane)
      for (size_t r = 0; r < out.rowsEach; ++r) {
        const size_t row = first + r * kLanes + lane;
        rows.push_back(row < inner.size() ? inner[row] : kNoRow);
      }
  out.firstBorderRow = static_cast<uint32_t>(rows.size());
  std::vector<surfaces::Place> ends = {{0, 0}, {n, 0}, {0, n}};
  if (!triangle) ends = {{0, 0}, {n, 0}, {n, n}, {0, n}};
  for (size_t s = 0; s < ends.size(); ++s) {
    const surfaces::Place &from = ends[s], &to = ends[(s + 1) % ends.size()];
    for (int i = 1; i < n; ++i)
      rows.push_back(rowOf.at({from[0] + (to[0] - from[0]) / n * i, from[1] + (to[1] - from[1]) / n * i}));
  }
  for (const surfaces::Place& end : ends) rows.push_back(rowOf.at(end));
  rows.resize((rows.size() + 3) / 4 * 4, kNoRow);
  out.rows = static_cast<uint32_t>(rows.size());
  return rows;
}

}  // namespace

MeshRecords meshRecords(const surfaces::TableLayout& layout) {
  MeshRecords out;
  const std::vector<uint32_t> rows = meshRows(layout, out);
  std::vector<uint32_t> firstWeights;
  const auto add = [&](const std::vector<double>& weights) {
    for (size_t first = 0; first < weights.size(); first += layout.rows())
      for (const uint32_t row : rows)
        out.weights.push_back(row == kNoRow ? 0.0F : static_cast<float>(weights[first + row]));
  };
  for (const surfaces::BasisTable& table : layout.tables) {
    firstWeights.push_back(static_cast<uint32_t>(out.weights.size()));
    add(table.weights);
  }
  out.tangentStride = static_cast<uint32_t>(out.weights.size());
  for (size_t t = 0; t < 2; ++t) {
    out.weights.resize((t + 1) * out.tangentStride);  // tables of attributes alone have no tangents
    for (const surfaces::BasisTable& table : layout.tables) add(table.tangents[t]);
  }
  out.sources.resize(layout.fineEdges + layout.controls.size());
  uint32_t points = 0, attributePoints = 0;
  for (uint32_t p = 0; p < layout.patches.size(); ++p) {
    const surfaces::TablePatch& patch = layout.patches[p];
    const auto count = static_cast<uint32_t>(patch.controls.size());
    out.patches.push_back({points, count, firstWeights[patch.table], 0});
    points += count;
    if (!patch.attributeControls.empty()) {
      const auto values = static_cast<uint32_t>(patch.attributeControls.size());
      out.attributePatches.push_back({attributePoints, values, firstWeights[patch.attributeTable], 0});
      out.attributePoints.insert(out.attributePoints.end(), patch.attributeControls.begin(),
                                 patch.attributeControls.end());
      attributePoints += values;
    }
    for (uint32_t s = 0; s < layout.corners(); ++s) {
      if (patch.writesEdge[s]) out.sources[patch.edges[s]] = {patch.edgeSources[s], 8 * p + 2 * s};
      if (patch.writesCorner[s])
        out.sources[layout.fineEdges + patch.controls[s]] = {patch.cornerSources[s], 4 * p + s};
    }
  }
  return out;
}

std::vector<uint32_t> placeRecords(const surfaces::TableLayout& layout) {
  std::vector<uint32_t> out;
  const size_t side = (size_t{1} << layout.tableLevel) + 1;
  for (const surfaces::Place& place : layout.places)
    out.push_back(static_cast<uint32_t>(place[0]) | static_cast<uint32_t>(place[1]) << 16);
  std::vector<uint32_t> rowOf(side * side, 0);
  for (uint32_t row = 0; row < layout.places.size(); ++row)
    rowOf[size_t(layout.places[row][0]) + side * size_t(layout.places[row][1])] = row;
  out.insert(out.end(), rowOf.begin(), rowOf.end());
  return out;
}

}  // namespace limen::techniques
