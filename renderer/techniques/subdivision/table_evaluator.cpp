// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/subdivision/table_evaluator.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/gtc/packing.hpp>

#include "renderer/techniques/subdivision/table_records.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {
namespace {

const std::string kFolder = "renderer/techniques/subdivision/";
constexpr int64_t kMostBytes = int64_t{3} << 30;  // of vertices or indices

surfaces::TableLayout layoutFor(const surfaces::SubdivisionSurface& surface,
                                const TableEvaluatorSettings& settings) {
  const int steps =
      std::max(settings.normals == NormalStart::Second ? 2 : 1, surfaces::stepsUntilSmooth(surface.cage));
  if (settings.level < steps)
    throw Error("tables start after " + std::to_string(steps) + " steps, where no edge is semi-sharp",
                "level", "use " + std::to_string(steps) + " or more");
  if (settings.normals == NormalStart::Geometry && surface.scheme != surfaces::SubdivisionScheme::Loop)
    throw Error("tables of tangents are of Loop's scheme alone", "normals", "use normals: first");
  const bool tangents = settings.normals == NormalStart::Geometry;
  if (!surface.attributes)
    return surfaces::tableLayout(surface.cage, surface.scheme, settings.level - steps, steps, tangents);
  const surfaces::PolygonMesh attributes = surfaces::attributeMesh(surface.cage, *surface.attributes);
  return surfaces::tableLayout(surface.cage, surface.scheme, settings.level - steps, steps, tangents,
                               &attributes);
}

uint32_t counted(int64_t count, int64_t bytesEach, const char* what) {
  if (count * bytesEach > kMostBytes)
    throw Error(std::to_string(count) + " " + what + " do not fit into a buffer", "level",
                "use a lower level");
  return static_cast<uint32_t>(count);
}

/// Of 1,024 numbers that a compute shader's uniforms may have anywhere, half.
constexpr size_t kMostUniformJoints = 32;

gl::ShaderDefines skinningDefines(const surfaces::SubdivisionSurface& surface) {
  return {{"JOINTS", std::to_string(surface.joints.size())},
          {"MOST_UNIFORM_JOINTS", std::to_string(kMostUniformJoints)}};
}

/// Groups of the usual size, in rows where there are many.
void dispatchGroups(uint32_t groups) {
  const uint32_t rows = (groups + 65534) / 65535;
  glDispatchCompute((groups + rows - 1) / rows, rows, 1);
}

}  // namespace

TableEvaluator::TableEvaluator(gl::Context& context, const surfaces::SubdivisionSurface& surface,
                               uint32_t material, glm::dvec3 anchor, const TableEvaluatorSettings& settings)
    : settings_(settings),
      surface_(surface),
      anchor_(anchor),
      layout_(layoutFor(surface, settings)),
      vertexCount_(counted(layout_.verticesAt(settings.level - layout_.steps),
                           int64_t{sizeof(TessellatedVertex)}, "vertices")),
      triangleCount_(counted(layout_.trianglesAt(settings.level - layout_.steps), 12, "triangles")),
      material_(material),
      rest_(cageRecords(surface, anchor)),
      joints_(int64_t(std::max<size_t>(surface.joints.size(), 1)) * int64_t{sizeof(glm::mat4)}, nullptr),
      positions_(int64_t(surface.cage.points.size()) * 16, nullptr),
      entries_(0, nullptr),
      terms_(0, nullptr),
      fans_(0, nullptr),
      controls_(int64_t(layout_.controls.size()) * int64_t{sizeof(ControlVertex)}, nullptr),
      patches_(0, nullptr),
      points_(0, nullptr),
      tables_(tableWeights(layout_)),
      places_(placeRecords(layout_)),
      animate_(context.programs().compute(kFolder + "animate.comp.glsl", skinningDefines(surface))),
      controlsProgram_(context.programs().compute(kFolder + "controls.comp.glsl",
                                                  settings.normals == NormalStart::Cage
                                                      ? gl::ShaderDefines{{"NORMALS_FROM_CAGE", "1"}}
                                                      : skinningDefines(surface))) {
  const EntryRecords records = entryRecords(layout_);
  entries_ = gl::Buffer(records.entries);
  terms_ = gl::Buffer(records.terms);
  fans_ = gl::Buffer(records.fans);
  const PatchRecords patches = patchRecords(layout_, material);
  patches_ = gl::Buffer(patches.patches);
  points_ = gl::Buffer(patches.points);
  if (settings.normals == NormalStart::Cage) {
    const EntryRecords cage = cageFanRecords(surface.cage);
    cageEntries_.emplace(cage.entries);
    cageFans_.emplace(cage.fans);
    cageNormals_.emplace(int64_t(surface.cage.points.size()) * 16, nullptr);
    cageNormalsProgram_ = &context.programs().compute(kFolder + "cage_normals.comp.glsl");
  } else {
    normalsProgram_ = &context.programs().compute(kFolder + "control_normals.comp.glsl");
  }
}

gl::ShaderDefines TableEvaluator::defines() const {
  gl::ShaderDefines out;
  out["CORNERS"] = std::to_string(layout_.corners());
  out["TABLE_SEGMENTS"] = std::to_string(1 << layout_.tableLevel);
  if (settings_.normals == NormalStart::Geometry) out["GEOMETRY_NORMALS"] = "1";
  if (patchAttributes_) out["TEXTURED"] = "1";
  return out;
}

void TableEvaluator::bindTables(const gl::Program& program) const {
  patches_.bindStorage(kSubdivisionPatchesBuffer);
  points_.bindStorage(kSubdivisionPointsBuffer);
  tables_.bindStorage(kSubdivisionTablesBuffer);
  places_.bindStorage(kSubdivisionPlacesBuffer);
  controls_.bindStorage(kControlsBuffer);
  if (patchAttributes_) patchAttributes_->bindTexture(kPatchAttributesUnit);
  program.use();
  const auto controls = static_cast<uint32_t>(layout_.controls.size());
  program.set("rows", layout_.rows());
  program.set("tangentStride", static_cast<uint32_t>(layout_.tableBytes() / 4));
  program.set("firstEdgeVertex", controls);
  program.set("firstInnerVertex", controls + layout_.fineEdges * static_cast<uint32_t>(segments() - 1));
}

void TableEvaluator::allocateMesh(gl::Context& context) {
  vertices_.emplace(int64_t{vertexCount_} * int64_t{sizeof(TessellatedVertex)}, nullptr);
  indices_.emplace((int64_t{triangleCount_} * 12 + 15) / 16 * 16, nullptr);
  const gl::Program& program = context.programs().compute(kFolder + "fine_indices.comp.glsl", defines());
  bindTables(program);
  indices_->bindStorage(kFineIndicesBuffer);
  program.set("segments", segments());
  program.set("triangleCount", triangleCount_);
  dispatchGroups((triangleCount_ + uint32_t(kSubdivisionGroup) - 1) / uint32_t(kSubdivisionGroup));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT);

  const MeshRecords records = meshRecords(layout_);
  meshPatches_.emplace(records.patches);
  meshWeights_.emplace(records.weights);
  meshSources_.emplace(records.sources);
  gl::ShaderDefines given = defines();
  given["ROWS"] = std::to_string(records.rowsEach);
  given["SLOTS"] = std::to_string(layout_.mostSlots());
  if (surface_.attributes) {
    given["TEXTURED"] = "1";
    makeAttributes(context, records);
  }
  main_ = &context.programs().compute(kFolder + "fine_vertices.comp.glsl", given);
  meshRows_ = {records.innerRows, records.firstBorderRow, records.rows, records.tangentStride};
}

void TableEvaluator::makeAttributes(gl::Context& context, const MeshRecords& records) {
  std::vector<glm::vec4> values;
  for (const glm::dvec3& value : layout_.attributeControls) values.emplace_back(value, 0.0);
  const gl::Buffer patches(records.attributePatches), points(records.attributePoints), given(values);
  attributes_.emplace(int64_t{vertexCount_} * 16, nullptr);
  packedAttributes_.emplace((int64_t{vertexCount_} * 4 + 15) / 16 * 16, nullptr);
  gl::ShaderDefines defined = defines();
  defined["ROWS"] = std::to_string(records.rowsEach);
  const gl::Program& program = context.programs().compute(kFolder + "fine_attributes.comp.glsl", defined);
  patches.bindStorage(kSubdivisionPatchesBuffer);
  points.bindStorage(kSubdivisionPointsBuffer);
  meshWeights_->bindStorage(kSubdivisionTablesBuffer);
  meshSources_->bindStorage(kSubdivisionSourcesBuffer);
  given.bindStorage(kAttributeValuesBuffer);
  attributes_->bindStorage(kFineAttributesBuffer);
  packedAttributes_->bindStorage(kPackedAttributesBuffer);
  program.use();
  program.set("rows", records.rows);
  program.set("innerRows", records.innerRows);
  program.set("firstBorderRow", records.firstBorderRow);
  program.set("cornerCount", static_cast<uint32_t>(layout_.controls.size()));
  program.set("edgeCount", layout_.fineEdges);
  program.set("level", layout_.tableLevel);
  dispatch(program, "vertexCount", vertexCount_);
}

void TableEvaluator::makePatchAttributes() {
  constexpr size_t kAcross = kPatchAttributesAcross, kMostDown = 16384;
  const size_t rows = layout_.rows(), down = (layout_.patches.size() * rows + kAcross - 1) / kAcross;
  if (down > kMostDown)
    throw Error("texture coordinates of all patches do not fit into a texture", "level",
                "use a lower level, or form: compute and refinement: uniform");
  std::vector<uint32_t> texels;
  texels.reserve(kAcross * down);
  for (const surfaces::TablePatch& patch : layout_.patches) {
    const std::vector<double>& weights = layout_.tables[patch.attributeTable].weights;
    for (size_t row = 0; row < rows; ++row) {
      glm::dvec2 sum(0.0);
      for (size_t s = 0; s < patch.attributeControls.size(); ++s)
        sum += weights[s * rows + row] * glm::dvec2(layout_.attributeControls[patch.attributeControls[s]]);
      texels.push_back(glm::packUnorm2x16(glm::vec2(sum)));
    }
  }
  texels.resize(kAcross * down);
  patchAttributes_.emplace(gl::Format::R32UI, glm::ivec2(kPatchAttributesAcross, static_cast<int>(down)));
  patchAttributes_->writeUint(texels);
}

void TableEvaluator::dispatch(const gl::Program& program, const char* count, uint32_t of) const {
  program.use();
  program.set(count, of);
  dispatchGroups((of + uint32_t(kSubdivisionGroup) - 1) / uint32_t(kSubdivisionGroup));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void TableEvaluator::bindPose(const gl::Program& program, double timeS) const {
  std::vector<glm::mat4> joints;
  glm::dmat4 toAnchor(1.0), fromAnchor(1.0);
  toAnchor[3] = glm::dvec4(-anchor_, 1.0), fromAnchor[3] = glm::dvec4(anchor_, 1.0);
  for (const surfaces::Joint& joint : surface_.joints)
    joints.emplace_back(toAnchor * joint.at(timeS) * fromAnchor);
  if (joints.size() > kMostUniformJoints) {
    joints_.write(0, int64_t(joints.size() * sizeof(glm::mat4)), joints.data());
    joints_.bindStorage(kCageJointsBuffer);
  } else {
    program.use();
    for (size_t j = 0; j < joints.size(); ++j)
      program.set(("joints[" + std::to_string(j) + "]").c_str(), joints[j]);
  }
  rest_.bindStorage(kCageRestBuffer);
}

void TableEvaluator::runFirstSteps(frame::Frame& frame, double timeS, bool normals) const {
  const auto cage = static_cast<uint32_t>(surface_.cage.points.size()),
             controls = static_cast<uint32_t>(layout_.controls.size());
  if (cageNormalsProgram_) {
    {
      const auto scope = frame.passes().open("subdivision/animate");
      bindPose(animate_, timeS);
      positions_.bindStorage(kCagePositionsBuffer);
      dispatch(animate_, "vertexCount", cage);
    }
    const auto scope = frame.passes().open("subdivision/cage_normals");
    cageEntries_->bindStorage(kControlEntriesBuffer);
    cageFans_->bindStorage(kFansBuffer);
    cageNormals_->bindStorage(kCageNormalsBuffer);
    dispatch(*cageNormalsProgram_, "vertexCount", cage);
  }
  {
    const auto scope = frame.passes().open("subdivision/first_positions");
    if (!cageNormalsProgram_) bindPose(controlsProgram_, timeS);
    entries_.bindStorage(kControlEntriesBuffer);
    terms_.bindStorage(kStencilTermsBuffer);
    controls_.bindStorage(kControlsBuffer);
    dispatch(controlsProgram_, "controlCount", controls);
  }
  if (normals && normalsProgram_) {
    const auto scope = frame.passes().open("subdivision/first_normals");
    fans_.bindStorage(kFansBuffer);
    dispatch(*normalsProgram_, "controlCount", controls);
  }
}

void TableEvaluator::runMain(frame::Frame& frame) const {
  const auto scope = frame.passes().open("subdivision/main");
  meshPatches_->bindStorage(kSubdivisionPatchesBuffer);
  points_.bindStorage(kSubdivisionPointsBuffer);
  meshWeights_->bindStorage(kSubdivisionTablesBuffer);
  meshSources_->bindStorage(kSubdivisionSourcesBuffer);
  controls_.bindStorage(kControlsBuffer);
  vertices_->bindStorage(kFineVerticesBuffer);
  if (packedAttributes_) packedAttributes_->bindStorage(kPackedAttributesBuffer);
  const auto groupsFor = [](uint64_t items) { return uint32_t((items + kMeshLanes - 1) / kMeshLanes); };
  const uint32_t corners = static_cast<uint32_t>(layout_.controls.size()),
                 patches = static_cast<uint32_t>(layout_.patches.size()), cornerGroups = groupsFor(corners),
                 edgeGroups =
                     segments() > 1 ? groupsFor(uint64_t{layout_.fineEdges} << layout_.tableLevel) : 0,
                 innerGroups = segments() > 1 ? patches : 0;
  main_->use();
  main_->set("innerRows", meshRows_.inner);
  main_->set("firstBorderRow", meshRows_.firstBorder);
  main_->set("rows", meshRows_.all);
  main_->set("tangentStride", meshRows_.tangentStride);
  main_->set("level", layout_.tableLevel);
  main_->set("material", material_);
  main_->set("cornerGroups", cornerGroups);
  main_->set("edgeGroups", edgeGroups);
  main_->set("cornerCount", corners);
  main_->set("edgeCount", layout_.fineEdges);
  main_->set("patchCount", patches);
  dispatchGroups(cornerGroups + edgeGroups + innerGroups);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

int64_t TableEvaluator::bytes() const {
  return patches_.bytes() + points_.bytes() + tables_.bytes() + places_.bytes() +
         (patchAttributes_ ? patchAttributes_->bytes() : 0);
}

void TableEvaluator::stateBytes(frame::Frame& frame) const {
  frame.passes().setBytesHeld("subdivision/first_positions", rest_.bytes() + joints_.bytes() +
                                                                 positions_.bytes() + entries_.bytes() +
                                                                 terms_.bytes() + controls_.bytes());
  frame.passes().setBytesHeld("subdivision/first_normals", fans_.bytes());
  frame.passes().setBytesHeld(
      "subdivision/main",
      bytes() + (vertices_ ? vertices_->bytes() + indices_->bytes() + meshPatches_->bytes() +
                                 meshWeights_->bytes() + meshSources_->bytes() +
                                 (attributes_ ? attributes_->bytes() + packedAttributes_->bytes() : 0)
                           : 0));
}

}  // namespace limen::techniques
