// SPDX-License-Identifier: BSD-3-Clause
// Catmull-Clark surfaces by subdivision on the GPU (SC-26): after a step or two that separate extraordinary
// vertices, each quad becomes a fragment with the vertices around it, which compute shaders subdivide step by
// step. With the same level for all this is what Losasso et al. 2003 do in geometry images and Shiue, Jones
// and Peters 2005 in fragment meshes; with a level for each fragment what Bunnell 2005 does. Differences:
// - Compute shaders and buffers in place of pixel shaders and textures.
// - Vertices are moved to the limit in the end, and normals are the limit surface's.
// - Levels come from a bound on the deviation, and sides have levels of their own, so that neighbours of
// different levels meet without cracks.
#include <epoxy/gl.h>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/subdivision/fragments/fragment_refinement.h"
#include "renderer/techniques/subdivision/subdivision_bindings.h"
#include "renderer/techniques/subdivision/table_evaluator.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/surface_picture.h"
#include "renderer/techniques/tessellation/surface_vertex_array.h"

namespace limen::techniques {
namespace {

struct SameLevels {
  static constexpr const char *kKind = "uniform", *kSummary = "the same for all";
};

struct FragmentSettings {
  int level = 4;
  std::variant<SameLevels, FlatLevels> levels;
  double poseS = 0.0;
  frame::Raster raster = frame::Raster::Auto;
  frame::ShadedSetting shading;
  static const SettingsTable<FragmentSettings>& table() {
    using S = FragmentSettings;
    static const SettingsTable<S> kTable = {
        {&S::level,
         "level",
         {2, 8},
         "steps",
         "Steps of subdivision from the control mesh, at most",
         "Schwarz 2009, section 6.3"},
        {&S::levels, "levels", "How many of these steps a fragment gets",
         "Shiue, Jones and Peters 2005; Bunnell 2005"},
        {&S::poseS,
         "pose_s",
         {0.0, 3600.0},
         "s",
         "Time of the joints' pose at the beginning of the camera's path"},
        {&S::raster, "raster", "How triangles become pixels"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class FragmentMeshes : public Technique {
 public:
  using Settings = FragmentSettings;
  explicit FragmentMeshes(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    const scene::Scene& scene = frame.scene();
    if (scene.subdivisions.size() != 1)
      throw Error("the scene has " + std::to_string(scene.subdivisions.size()) + " subdivision surfaces", "",
                  "use a scene with one");
    const surfaces::SubdivisionSurface& surface = scene.subdivisions[0];
    if (surface.scheme != surfaces::SubdivisionScheme::CatmullClark)
      throw Error("fragment meshes are of Catmull-Clark's scheme", "scheme", "use scheme: catmull_clark");
    if (surface.attributes)
      throw Error("fragment meshes have no texture coordinates", "cage",
                  "use another cage, or technique subdivision/tables");
    const uint32_t material = scene.parts[surface.part].material;
    evaluate(frame, surface, material, NormalStart::First);
    if (!isSeparated(first_->layout().mesh)) evaluate(frame, surface, material, NormalStart::Second);
    refinement_.emplace(frame.context(), fragmentLayout(first_->layout().mesh, material),
                        settings_.level - first_->layout().steps, std::get_if<FlatLevels>(&settings_.levels));
    lists_ = frame::chosenRaster(settings_.raster, frame.context()) == frame::Raster::Compute;
    picture_.emplace(frame, settings_.shading, "subdivision",
                     lists_ ? frame::Raster::Compute : frame::Raster::Hardware);
    array_.emplace(refinement_->vertices(), refinement_->indices());
    program_ = &frame.context().programs().get({"renderer/techniques/tessellation/compute/surface.vert.glsl",
                                                "renderer/techniques/tessellation/surface.frag.glsl"});
    first_->stateBytes(frame);
    frame.passes().setBytesHeld("subdivision/refine", refinement_->bytes());
  }

  void render(frame::Frame& frame) override {
    first_->runFirstSteps(frame, settings_.poseS + frame.timeS(), false);
    refinement_->run(frame, first_->controls());
    if (lists_) {
      picture_->renderListed(frame, {refinement_->vertices(), refinement_->indices(), refinement_->totals(),
                                     refinement_->mostTriangles()});
      return;
    }
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT |
                    GL_COMMAND_BARRIER_BIT);
    picture_->render(frame, [&] {
      program_->use();
      program_->set("anchorToClip", frame::anchorToClip(frame));
      array_->bind();
      glBindBuffer(GL_DRAW_INDIRECT_BUFFER, refinement_->totals().id());
      glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                             reinterpret_cast<const void*>(offsetof(AdaptiveTotals, indices)));
      glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    });
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::vector<Counter> count(frame::Frame&) override {
    const AdaptiveTotals totals = refinement_->totals().read<AdaptiveTotals>()[0];
    double fragments = 0.0, finest = 0.0;
    for (const uint32_t of : refinement_->fragmentsByLevel()) fragments += of, finest = of;
    return {{"drawn_triangles", double(totals.triangles)},
            {"drawn_vertices", double(totals.vertices)},
            {"subdivided_points", refinement_->pointsMade()},
            {"finest_share", finest / fragments}};
  }
  static std::vector<Quantity> quantities() {
    const Direction lower = Direction::LowerIsBetter;
    return {{"drawn_triangles", "Triangles drawn", "triangles", lower},
            {"drawn_vertices", "Vertices, each fragment with its own", "vertices", lower},
            {"subdivided_points", "Points of fragments at all levels, those around them included", "points",
             lower},
            {"finest_share", "Share of the fragments that got all steps", "", lower}};
  }

 private:
  void evaluate(frame::Frame& frame, const surfaces::SubdivisionSurface& surface, uint32_t material,
                NormalStart start) {
    const int steps = start == NormalStart::Second ? 2 : 1;
    if (settings_.level < steps + 1)
      throw Error("fragments start after " + std::to_string(steps) + " steps", "level",
                  "use " + std::to_string(steps + 1) + " or more");
    first_.emplace(frame.context(), surface, material, frame.gpuScene().anchor(),
                   TableEvaluatorSettings{steps, start});
  }

  Settings settings_;
  std::optional<TableEvaluator> first_;  // steps before fragments
  std::optional<FragmentRefinement> refinement_;
  std::optional<SurfacePicture> picture_;
  std::optional<SurfaceVertexArray> array_;
  const gl::Program* program_ = nullptr;
  bool lists_ = false;
};

const RegisteredTechnique<FragmentMeshes> kFragmentMeshesRegistered{
    {.name = "subdivision/fragment_meshes",
     .version = 1,
     .summary =
         "Catmull-Clark surfaces subdivided on the GPU quad by quad, all alike or each as far as needed",
     .source = "Shiue, Jones and Peters 2005; Bunnell 2005; Schwarz 2009, section 6.3 (SC-26)",
     .product = ProductKind::Colour,
     .needs = {"subdivision_surfaces"},
     .counters = FragmentMeshes::quantities(),
     .effort = "level"}};

}  // namespace
}  // namespace limen::techniques
