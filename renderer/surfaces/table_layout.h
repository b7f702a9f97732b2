// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/basis_tables.h"

namespace limen::surfaces {

/// A refined vertex as the faces of one sector between sharp edges see it: each sector has a normal of its
/// own.
struct TableControl {
  uint32_t vertex = 0;        ///< of the refined mesh; controls 0 to vertices - 1 are the first of each
  std::vector<uint32_t> fan;  ///< refined vertices around the sector, counter-clockwise
  bool closed = true;         ///< the fan's last vertex is followed by its first
};

/// A face of the refined mesh.
struct TablePatch {
  uint32_t table = 0;
  std::vector<uint32_t> controls;   ///< one for each of the table's slots; the corners first
  std::array<uint32_t, 4> edges{};  ///< numbers of the fine edges along sides 0.. (from corner s to s + 1)
  /// Whose row gives the position of a side's vertices, and of a corner's: 8 patch + 2 side + (1: the other
  /// way), 4 patch + corner. Both neighbours take the same, so that they agree in every bit.
  std::array<uint32_t, 4> edgeSources{}, cornerSources{};
  std::array<bool, 4> writesEdge{}, writesCorner{};  ///< of the one vertex that several patches share
  uint32_t parent = 0;                               ///< face of the control mesh
  /// Of attributes: seams are boundaries, so that it is the same table only where none is near.
  uint32_t attributeTable = 0;
  std::vector<uint32_t> attributeControls;  ///< one for each of that table's slots
};

/// How a control mesh is evaluated by tables (Holländer 2013, sections 2.2.1 to 2.2.3); made once for its
/// connectivity. Vertices of the drawn mesh, with n segments a side: one for each control, then n - 1 for
/// each fine edge, then those inside each patch.
struct TableLayout {
  SubdivisionScheme scheme{};
  int steps = 1;                 ///< of subdivision before tables
  int tableLevel = 5;            ///< 2^tableLevel segments a side of a patch
  RuleMesh mesh;                 ///< refined
  std::vector<Stencil> entries;  ///< of each refined vertex, over the control mesh's points
  std::vector<TableControl> controls;
  std::vector<TablePatch> patches;
  std::vector<BasisTable> tables;
  std::vector<Place> places;
  uint32_t fineEdges = 0;
  std::vector<glm::dvec3> attributeControls;  ///< values after the first steps; empty without attributes

  size_t corners() const { return cornersOf(scheme); }
  uint32_t rows() const { return placesAt(corners(), tableLevel); }
  int64_t tableBytes() const;  ///< in single precision
  size_t mostSlots() const;
  int64_t verticesAt(int level) const;  ///< drawn, of 2^level segments a patch
  int64_t trianglesAt(int level) const;
};

/// Slots that a table may have at most: 2 for each edge of a vertex of valence 58 and its surroundings.
inline constexpr size_t kMostSlots = 64;

/// `attributes`: a mesh of their values, with the faces of `mesh`; vertices of the drawn mesh are then
/// divided along seams. `steps`: stepsUntilSmooth() or more. Throws Error where ruleMesh() does, of either
/// mesh, or where a vertex has more edges than tables take.
TableLayout tableLayout(const PolygonMesh& mesh, SubdivisionScheme scheme, int tableLevel, int steps = 1,
                        bool tangents = false, const PolygonMesh* attributes = nullptr);

}  // namespace limen::surfaces
