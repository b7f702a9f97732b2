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
    for (const surfaces::BasisTable& table : layout.tables)
      out.insert(out.end(), table.tangents[t].begin(), table.tangents[t].end());
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
