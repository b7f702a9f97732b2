// SPDX-License-Identifier: BSD-3-Clause
// A layout as the shaders of subdivision read it.
#pragma once

#include "renderer/surfaces/subdivision_surface.h"
#include "renderer/surfaces/table_layout.h"
#include "renderer/techniques/subdivision/subdivision_bindings.h"

namespace limen::techniques {

std::vector<CageVertex> cageRecords(const surfaces::SubdivisionSurface& surface, glm::dvec3 anchor);

/// Entries of controls with what they refer to.
struct EntryRecords {
  std::vector<ControlEntry> entries;
  std::vector<StencilTerm> terms;
  std::vector<uint32_t> fans;
};
EntryRecords entryRecords(const surfaces::TableLayout& layout);
/// Fans alone, of the control mesh's own vertices. Across sharp edges there is one normal.
EntryRecords cageFanRecords(const surfaces::PolygonMesh& cage);

struct PatchRecords {
  std::vector<SubdivisionPatch> patches;
  std::vector<uint32_t> points;
};
PatchRecords patchRecords(const surfaces::TableLayout& layout, uint32_t material);
/// Tables in succession; those of tangents follow all of positions, then come those of the other tangents.
std::vector<float> tableWeights(const surfaces::TableLayout& layout);

/// What the main step in compute reads: see MeshPatch. Sources of fine edges, then of controls.
struct MeshRecords {
  std::vector<MeshPatch> patches;
  std::vector<float> weights;
  std::vector<glm::uvec2> sources;
  std::vector<MeshPatch> attributePatches;  ///< of the same weights; their points are values of attributes
  std::vector<uint32_t> attributePoints;
  uint32_t rowsEach = 1;  ///< of an invocation, inside a patch: 1, 2 or 4
  uint32_t innerRows = 0, firstBorderRow = 0, rows = 0;
  uint32_t tangentStride = 0;  ///< in weights
};
MeshRecords meshRecords(const surfaces::TableLayout& layout);
std::vector<uint32_t> placeRecords(const surfaces::TableLayout& layout);

}  // namespace limen::techniques
