// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/frame/frame.h"
#include "renderer/gl/texture.h"
#include "renderer/surfaces/table_layout.h"

namespace limen::techniques {

struct MeshRecords;

/// Where Subdivision Shading starts (Alexa and Boubekeur 2008; Holländer 2013, section 2.2.2): normals are
/// found from triangles there and subdivided from there on as positions are.
enum class NormalStart {
  Cage,     ///< of the control mesh
  First,    ///< after one step
  Second,   ///< after two, which tables then start from
  Geometry  ///< no subdivision of normals: the limit surface's own, from tables of tangents
};
constexpr EnumNames<NormalStart, 4> enumNames(NormalStart) {
  return {{{{NormalStart::Cage, "cage"},
            {NormalStart::First, "first"},
            {NormalStart::Second, "second"},
            {NormalStart::Geometry, "geometry"}}}};
}

struct TableEvaluatorSettings {
  int level = 4;  ///< steps of subdivision from the control mesh that the drawn mesh is worth; 1..8
  NormalStart normals = NormalStart::First;
};

/// A subdivision surface in GPU memory: tables, made once for the connectivity of the control mesh, and the
/// passes that evaluate it anew in each frame, in the pose of that moment.
class TableEvaluator {
 public:
  /// Throws Error where tableLayout() does, or the drawn mesh would not fit into buffers.
  TableEvaluator(gl::Context& context, const surfaces::SubdivisionSurface& surface, uint32_t material,
                 glm::dvec3 anchor, const TableEvaluatorSettings& settings);

  /// First steps: positions and normals of the refined mesh, from the skinned control mesh. Passes
  /// "first_positions" and "first_normals", the last only with `normals`; where normals start from the
  /// control mesh, "animate", "cage_normals" and "first_positions".
  void runFirstSteps(frame::Frame& frame, double timeS, bool normals = true) const;
  /// Main step in compute: all drawn vertices. Pass "main".
  void runMain(frame::Frame& frame) const;
  void stateBytes(frame::Frame& frame) const;

  const surfaces::TableLayout& layout() const { return layout_; }
  int segments() const { return 1 << (settings_.level - layout_.steps); }  ///< a side of a patch
  uint32_t vertexCount() const { return vertexCount_; }                    ///< drawn
  uint32_t triangleCount() const { return triangleCount_; }
  const gl::Buffer& vertices() const { return *vertices_; }  ///< TessellatedVertex
  const gl::Buffer& indices() const { return *indices_; }    ///< three a triangle
  /// vec4 of texture coordinates and one more for each drawn vertex; null if the surface has no attributes.
  const gl::Buffer* attributes() const { return attributes_ ? &*attributes_ : nullptr; }
  const gl::Buffer& controls() const { return controls_; }  ///< ControlVertex
  /// Makes vertices() and indices(), which forms that draw patches do not need.
  void allocateMesh(gl::Context& context);
  /// Texture coordinates for forms that draw patches one by one, which do not need vertices(). Before
  /// defines() is asked. Throws Error if a texture cannot hold them.
  void makePatchAttributes();
  /// For programs that include tables.glsl.
  void bindTables(const gl::Program& program) const;
  gl::ShaderDefines defines() const;
  int64_t bytes() const;

 private:
  void dispatch(const gl::Program& program, const char* count, uint32_t of) const;
  void makeAttributes(gl::Context& context, const MeshRecords& records);
  void bindPose(const gl::Program& program, double timeS) const;

  TableEvaluatorSettings settings_;
  surfaces::SubdivisionSurface surface_;
  glm::dvec3 anchor_;
  surfaces::TableLayout layout_;
  uint32_t vertexCount_, triangleCount_, material_;
  gl::Buffer rest_, joints_, positions_, entries_, terms_, fans_, controls_;
  std::optional<gl::Buffer> cageNormals_, cageEntries_, cageFans_;
  gl::Buffer patches_, points_, tables_, places_;
  std::optional<gl::Texture> patchAttributes_;
  std::optional<gl::Buffer> vertices_, indices_, meshPatches_, meshWeights_, meshSources_, attributes_,
      packedAttributes_;
  const gl::Program &animate_, &controlsProgram_;
  const gl::Program *normalsProgram_ = nullptr, *cageNormalsProgram_ = nullptr, *main_ = nullptr;
  struct {
    uint32_t inner = 0, firstBorder = 0, all = 0, tangentStride = 0;
  } meshRows_;  ///< see MeshRecords
};

}  // namespace limen::techniques
