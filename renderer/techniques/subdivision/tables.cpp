// SPDX-License-Identifier: BSD-3-Clause
// Subdivision surfaces by precomputed tables of basis functions (Holländer 2013, chapter 2; HOL-01 to
// HOL-13). Differences from the thesis:
// - Tables are made for the configurations that a mesh has, at the level that is asked for; sharp edges are
// boundaries
//   of their two sides. Valences up to 58 have tables.
// - Lists of entries in place of arrays padded to the largest valence.
// - Both patches along an edge take its positions from the same row of the same table, so that there are no
// cracks.
// - In compute, neighbouring patches share vertices; triangles are listed once.
#include <epoxy/gl.h>

#include <algorithm>
#include <optional>

#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/subdivision/adaptive_mesh.h"
#include "renderer/techniques/subdivision/subdivision_bindings.h"
#include "renderer/techniques/subdivision/table_evaluator.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/surface_picture.h"
#include "renderer/techniques/tessellation/surface_vertex_array.h"

namespace limen::techniques {
namespace {

/// llvmpipe draws wrong triangles beyond as many tessellation vertices a draw.
constexpr int kStageVerticesPerSoftwareDraw = 65536;

enum class MainStep { Compute, Instanced, Stages };
constexpr EnumNames<MainStep, 3> enumNames(MainStep) {
  return {{{{MainStep::Compute, "compute"},
            {MainStep::Instanced, "instanced"},
            {MainStep::Stages, "tessellation_stages"}}}};
}

struct UniformLevels {
  static constexpr const char *kKind = "uniform", *kSummary = "the same level everywhere";
};

struct TablesSettings {
  int level = 4;
  MainStep form = MainStep::Compute;
  std::variant<UniformLevels, AdaptiveMeshSettings> refinement;
  NormalStart normals = NormalStart::First;
  double poseS = 0.0;
  frame::Raster raster = frame::Raster::Auto;
  frame::ShadedSetting shading;
  static const SettingsTable<TablesSettings>& table() {
    using S = TablesSettings;
    static const SettingsTable<S> kTable = {
        {&S::level,
         "level",
         {1, 8},
         "steps",
         "Steps of subdivision from the control mesh that the drawn mesh is worth: 4^level triangles for "
         "each of the "
         "control mesh's",
         "Holländer 2013, Table 2.1"},
        {&S::form, "form",
         "Who evaluates: compute shaders, once for each vertex; the vertex shader, for each patch an "
         "instance of a "
         "pattern; or the driver's tessellation stages, whose inner vertices of triangles lie on the plane "
         "between three of the tables' ones",
         "Holländer 2013, section 2.2.3"},
        {&S::refinement, "refinement", "Which level a patch and its edges have",
         "Holländer 2013, section 2.2.3"},
        {&S::normals, "normals",
         "Where normals are taken from triangles, to be subdivided from there on, or else "
         "the surface's own",
         "Holländer 2013, section 2.2.2 (first)"},
        {&S::poseS,
         "pose_s",
         {0.0, 3600.0},
         "s",
         "Time of the joints' pose at the beginning of the camera's path"},
        {&S::raster, "raster", "How triangles of the form compute become pixels"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
  const AdaptiveMeshSettings* adaptive() const { return std::get_if<AdaptiveMeshSettings>(&refinement); }
  void check() const {
    if (adaptive() && form != MainStep::Compute)
      throw Error("levels of edges are made in compute", "refinement", "use form: compute");
    if (form != MainStep::Compute && raster == frame::Raster::Compute)
      throw Error("vertex shaders and tessellation stages are for the driver's rasteriser", "raster",
                  "use raster: hardware");
    if (form == MainStep::Stages && level > 7)
      throw Error("a side has at most 64 segments in the driver's tessellation", "level", "use 7 or less");
  }
};

class SubdivisionTables : public Technique {
 public:
  using Settings = TablesSettings;
  explicit SubdivisionTables(const Settings& settings) : settings_(settings) {}
  ~SubdivisionTables() override {
    if (patternArray_) glDeleteVertexArrays(1, &patternArray_);
  }

  void prepare(frame::Frame& frame) override {
    const scene::Scene& scene = frame.scene();
    if (scene.subdivisions.size() != 1)
      throw Error("the scene has " + std::to_string(scene.subdivisions.size()) + " subdivision surfaces", "",
                  "use a scene with one");
    const surfaces::SubdivisionSurface& surface = scene.subdivisions[0];
    evaluator_.emplace(frame.context(), surface, scene.parts[surface.part].material,
                       frame.gpuScene().anchor(), TableEvaluatorSettings{settings_.level, settings_.normals});
    const bool compute = settings_.form == MainStep::Compute, textured = surface.attributes.has_value();
    if (surfaces::stepsUntilSmooth(surface.cage) > 4)
      throw Error("an edge is semi-sharp for more than 4 steps", "scene",
                  "use a lower sharpness, or 10: sharp for ever");
    if (textured && (!compute || settings_.adaptive())) evaluator_->makePatchAttributes();
    lists_ = compute && frame::chosenRaster(settings_.raster, frame.context()) == frame::Raster::Compute;
    picture_.emplace(frame, settings_.shading, "subdivision",
                     lists_ ? frame::Raster::Compute : frame::Raster::Hardware, textured);
    if (compute) {
      if (settings_.adaptive()) {
        adaptive_.emplace(frame.context(), *evaluator_, *settings_.adaptive());
        array_.emplace(adaptive_->vertices(), adaptive_->indices());
      } else {
        evaluator_->allocateMesh(frame.context());
        array_.emplace(evaluator_->vertices(), evaluator_->indices());
        const frame::RasterCount count{evaluator_->triangleCount(), 0, 0, 0};
        count_.emplace(int64_t{sizeof count}, &count);
      }
      drawProgram_ = &frame.context().programs().get(
          {"renderer/techniques/tessellation/compute/surface.vert.glsl",
           "renderer/techniques/tessellation/surface.frag.glsl"},
          textured ? gl::ShaderDefines{{"TEXTURED", "1"}} : gl::ShaderDefines{});
    } else {
      prepareDraw(frame);
    }
    evaluator_->stateBytes(frame);
    if (adaptive_) frame.passes().setBytesHeld("subdivision/levels", adaptive_->bytes());
  }

  void render(frame::Frame& frame) override {
    evaluator_->runFirstSteps(frame, settings_.poseS + frame.timeS());
    if (adaptive_)
      adaptive_->run(frame);
    else if (settings_.form == MainStep::Compute)
      evaluator_->runMain(frame);
    if (lists_ && adaptive_) {
      picture_->renderListed(frame, {adaptive_->vertices(), adaptive_->indices(), adaptive_->totals(),
                                     adaptive_->mostTriangles()});
      return;
    }
    if (lists_) {
      picture_->renderListed(frame, {evaluator_->vertices(), evaluator_->indices(), *count_,
                                     int64_t{evaluator_->triangleCount()}});
      return;
    }
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT |
                    GL_COMMAND_BARRIER_BIT);
    picture_->render(frame, [&] { draw(frame); });
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::vector<Counter> count(frame::Frame&) override {
    const surfaces::TableLayout& layout = evaluator_->layout();
    AdaptiveTotals totals{};
    if (adaptive_) totals = adaptive_->totals().read<AdaptiveTotals>()[0];
    return {{"drawn_triangles", double(adaptive_ ? totals.triangles : evaluator_->triangleCount())},
            {"drawn_vertices", double(adaptive_ ? totals.vertices : evaluator_->vertexCount())},
            {"tables", double(layout.tables.size())},
            {"table_bytes", double(layout.tableBytes())}};
  }
  static std::vector<Quantity> quantities() {
    return {{"drawn_triangles", "Triangles drawn", "triangles", Direction::LowerIsBetter},
            {"drawn_vertices", "Vertices, shared by neighbours", "vertices", Direction::LowerIsBetter},
            {"tables", "Tables of basis functions", "tables", Direction::Neither},
            {"table_bytes", "Memory of tables", "bytes", Direction::LowerIsBetter}};
  }

 private:
  void prepareDraw(frame::Frame& frame) {
    const std::string folder = "renderer/techniques/subdivision/",
                      fragment = "renderer/techniques/tessellation/surface.frag.glsl";
    gl::ProgramCache& programs = frame.context().programs();
    glCreateVertexArrays(1, &patternArray_);
    if (settings_.form == MainStep::Stages) {
      drawProgram_ = &programs.get(
          {folder + "patch.vert.glsl", folder + "patch.tesc.glsl", folder + "patch.tese.glsl", fragment},
          evaluator_->defines());
      return;
    }
    drawProgram_ = &programs.get({folder + "instanced.vert.glsl", fragment}, evaluator_->defines());
    pattern_.emplace(patternIndices());
    glVertexArrayElementBuffer(patternArray_, pattern_->id());
  }

  /// Rows of a table, three a triangle.
  std::vector<uint32_t> patternIndices() {
    const surfaces::TableLayout& layout = evaluator_->layout();
    std::map<surfaces::Place, uint32_t> rowOf;
    for (uint32_t row = 0; row < layout.places.size(); ++row) rowOf[layout.places[row]] = row;
    std::vector<uint32_t> out;
    const int n = 1 << layout.tableLevel;
    const auto add = [&](surfaces::Place a, surfaces::Place b, surfaces::Place c) {
      for (const surfaces::Place& place : {a, b, c}) out.push_back(rowOf.at(place));
    };
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < (layout.corners() == 3 ? n - y : n); ++x) {
        if (layout.corners() == 4) {
          add({x, y}, {x + 1, y}, {x + 1, y + 1});
          add({x, y}, {x + 1, y + 1}, {x, y + 1});
          continue;
        }
        add({x, y}, {x + 1, y}, {x, y + 1});
        if (x + y + 2 <= n) add({x + 1, y}, {x + 1, y + 1}, {x, y + 1});
      }
    return out;
  }

  void draw(frame::Frame& frame) const {
    if (settings_.form == MainStep::Compute) {
      drawProgram_->use();
      drawProgram_->set("anchorToClip", frame::anchorToClip(frame));
      array_->bind();
      if (adaptive_) {
        glBindBuffer(GL_DRAW_INDIRECT_BUFFER, adaptive_->totals().id());
        glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                               reinterpret_cast<const void*>(offsetof(AdaptiveTotals, indices)));
        glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
        return;
      }
      glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * evaluator_->triangleCount()), GL_UNSIGNED_INT,
                     nullptr);
      return;
    }
    evaluator_->bindTables(*drawProgram_);
    drawProgram_->set("anchorToClip", frame::anchorToClip(frame));
    glBindVertexArray(patternArray_);
    const auto patches = static_cast<GLsizei>(evaluator_->layout().patches.size());
    if (settings_.form == MainStep::Stages) {
      drawProgram_->set("segments", evaluator_->segments());
      glPatchParameteri(GL_PATCH_VERTICES, 1);
      const int each = (evaluator_->segments() + 1) * (evaluator_->segments() + 1);
      const GLsizei most = frame.context().device().software
                               ? std::max(kStageVerticesPerSoftwareDraw / each, 1)
                               : std::max(patches, 1);
      for (GLsizei first = 0; first < patches; first += most)
        glDrawArrays(GL_PATCHES, first, std::min(most, patches - first));
      return;
    }
    glDrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(pattern_->bytes() / 4), GL_UNSIGNED_INT,
                            nullptr, patches);
  }

  Settings settings_;
  std::optional<TableEvaluator> evaluator_;
  std::optional<AdaptiveMesh> adaptive_;
  std::optional<SurfacePicture> picture_;
  std::optional<SurfaceVertexArray> array_;
  std::optional<gl::Buffer> count_, pattern_;
  const gl::Program* drawProgram_ = nullptr;
  bool lists_ = false;
  uint32_t patternArray_ = 0;
};

const RegisteredTechnique<SubdivisionTables> kSubdivisionTablesRegistered{
    {.name = "subdivision/tables",
     .version = 3,
     .summary =
         "Limit points of subdivision surfaces from tables of basis functions, the control mesh moving",
     .source = "Holländer 2013, chapter 2 (HOL-02 to HOL-08)",
     .product = ProductKind::Colour,
     .needs = {"subdivision_surfaces"},
     .counters = SubdivisionTables::quantities(),
     .effort = "level"}};

}  // namespace
}  // namespace limen::techniques
