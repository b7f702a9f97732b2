// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/subdivision/adaptive_mesh.h"

#include <epoxy/gl.h>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/subdivision/subdivision_bindings.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {

const SettingsTable<AdaptiveMeshSettings>& AdaptiveMeshSettings::table() {
  using S = AdaptiveMeshSettings;
  static const SettingsTable<S> kTable = {
      {&S::levels, "by", "What gives an edge of the refined mesh its level",
       "bench; random: Holländer 2013, figure 2.11"},
      {&S::segmentPx,
       "segment_px",
       {0.25, 1024.0},
       "px",
       "Length on the screen that a segment may have, at the distance of its edge's middle",
       "bench (the thesis has no metric of its own)"},
      {&S::morph, "morph",
       "Vertices that a level adds come from between those of the level before, as edges near; otherwise "
       "levels "
       "are whole",
       "Holländer 2013, section 2.2.3"}};
  return kTable;
}

namespace {

const gl::Program& adaptiveProgram(gl::Context& context, const TableEvaluator& evaluator, const char* name) {
  return context.programs().compute(std::string("renderer/techniques/subdivision/") + name + ".comp.glsl",
                                    evaluator.defines());
}

int64_t bytesOfAll(int64_t patches, int64_t each, int64_t bytesEach) {
  const int64_t bytes = patches * each * bytesEach;
  if (bytes > int64_t{3} << 30)
    throw Error("vertices of all patches at the finest level do not fit into a buffer", "level",
                "use a lower level");
  return (bytes + 15) / 16 * 16;
}

}  // namespace

AdaptiveMesh::AdaptiveMesh(gl::Context& context, const TableEvaluator& evaluator,
                           const AdaptiveMeshSettings& settings)
    : evaluator_(evaluator),
      settings_(settings),
      patches_(static_cast<uint32_t>(evaluator.layout().patches.size())),
      levelsProgram_(adaptiveProgram(context, evaluator, "edge_levels")),
      countsProgram_(adaptiveProgram(context, evaluator, "adaptive_counts")),
      verticesProgram_(adaptiveProgram(context, evaluator, "adaptive_vertices")),
      indicesProgram_(adaptiveProgram(context, evaluator, "adaptive_indices")),
      levels_(int64_t{evaluator.layout().fineEdges} * 4, nullptr),
      counts_(compute::PrefixSum::bytesFor(patches_, 2), nullptr),
      offsets_(compute::PrefixSum::bytesFor(patches_, 2), nullptr),
      vertices_(bytesOfAll(patches_, evaluator.layout().rows(), int64_t{sizeof(TessellatedVertex)}), nullptr),
      indices_(bytesOfAll(evaluator.layout().trianglesAt(evaluator.layout().tableLevel), 3, 4), nullptr),
      totals_(int64_t{sizeof(AdaptiveTotals)}, nullptr),
      scan_(context, patches_, 2) {}

int64_t AdaptiveMesh::bytes() const {
  return levels_.bytes() + counts_.bytes() + offsets_.bytes() + vertices_.bytes() + indices_.bytes() +
         scan_.bytes();
}

void AdaptiveMesh::dispatchPatches(const gl::Program& program) const {
  program.set("patchCount", patches_);
  const uint32_t rows = (patches_ + 65534) / 65535;
  glDispatchCompute((patches_ + rows - 1) / rows, rows, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void AdaptiveMesh::run(frame::Frame& frame) const {
  {
    const auto scope = frame.passes().open("subdivision/levels");
    evaluator_.bindTables(levelsProgram_);
    levels_.bindStorage(kEdgeLevelsBuffer);
    levelsProgram_.set("eye", glm::vec3(frame.camera().eye - frame.gpuScene().anchor()));
    levelsProgram_.set("pxAtDistance", static_cast<float>(frame.sizePx().y / (2.0 * frame.tanHalfFov())));
    levelsProgram_.set("nearest", static_cast<float>(frame::nearPlane(frame)));
    levelsProgram_.set("segmentPx", static_cast<float>(settings_.segmentPx));
    levelsProgram_.set("randomLevels", settings_.levels == EdgeLevels::Random ? 1 : 0);
    levelsProgram_.set("wholeLevels", settings_.morph ? 0 : 1);
    levelsProgram_.set("mostLevel", evaluator_.layout().tableLevel);
    dispatchPatches(levelsProgram_);
    evaluator_.bindTables(countsProgram_);
    counts_.bindStorage(kPatchCountsBuffer);
    dispatchPatches(countsProgram_);
    scan_.run(counts_, offsets_, patches_);
  }
  {
    const auto scope = frame.passes().open("subdivision/main");
    evaluator_.bindTables(verticesProgram_);
    levels_.bindStorage(kEdgeLevelsBuffer);
    offsets_.bindStorage(kPatchOffsetsBuffer);
    vertices_.bindStorage(kFineVerticesBuffer);
    dispatchPatches(verticesProgram_);
  }
  const auto scope = frame.passes().open("subdivision/indices");
  evaluator_.bindTables(indicesProgram_);
  offsets_.bindStorage(kPatchOffsetsBuffer);
  indices_.bindStorage(kFineIndicesBuffer);
  totals_.bindStorage(kAdaptiveTotalsBuffer);
  dispatchPatches(indicesProgram_);
}

}  // namespace limen::techniques
