// SPDX-License-Identifier: BSD-3-Clause
// Recursive refinement on the CPU, in double precision (SC-37 to 43, 46): Schwarz 2009, section 7.2.
// Choices of the bench: flatness is measured on the screen alone; interiors of rectangles are tested as two
// triangles.
#include <epoxy/gl.h>

#include "renderer/frame/g_buffer.h"
#include "renderer/surfaces/recursion.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/patch_buffers.h"
#include "renderer/techniques/tessellation/surface_picture.h"
#include "renderer/techniques/tessellation/surface_vertex_array.h"
#include "renderer/techniques/tessellation/surface_view.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {
namespace {

struct CpuRecursionSettings {
  double tolerancePx = 0.5;
  surfaces::Flatness flatness = surfaces::Flatness::Control;
  surfaces::SplitPolicy split = surfaces::SplitPolicy::Halves;
  int mostSteps = 14;
  bool cull = true;
  surfaces::CrackHandling cracks = surfaces::CrackHandling::None;
  frame::ShadedSetting shading;
  static const SettingsTable<CpuRecursionSettings>& table() {
    using S = CpuRecursionSettings;
    static const SettingsTable<S> kTable = {
        {&S::tolerancePx,
         "tolerance_px",
         {0.01, 100},
         "px",
         "Flatness at which a part is drawn",
         "Schwarz 2009 (0.5)"},
        {&S::flatness, "flatness", "What of a part is measured", "Schwarz 2009, section 7.2.1"},
        {&S::split, "split", "How a part is split", "Schwarz 2009, sections 7.2.2, 7.2.3 and 7.2.5"},
        {&S::mostSteps, "most_steps", {0, 20}, "steps", "Splits from a patch to a part at most"},
        {&S::cull, "cull", "Leave out parts outside the view"},
        {&S::cracks, "cracks", "What keeps T-vertices on flat sides from leaving cracks",
         "Schwarz 2009, section 7.2.4"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
  surfaces::RecursionSettings recursion() const {
    return {flatness, split, tolerancePx, mostSteps, cull, cracks};
  }
};

class CpuRecursion : public Technique {
 public:
  using Settings = CpuRecursionSettings;
  explicit CpuRecursion(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    requireDrawn(frame.scene());
    picture_.emplace(frame, settings_.shading, "recursion");
    drawProgram_ =
        &frame.context().programs().get({"renderer/techniques/tessellation/compute/surface.vert.glsl",
                                         "renderer/techniques/tessellation/surface.frag.glsl"});
  }

  void render(frame::Frame& frame) override {
    const scene::Scene& scene = frame.scene();
    counts_ = {};
    auto surface = std::make_shared<surfaces::TessellatedSurface>(surfaces::refined(
        scene.surfaces, viewOf(frame), settings_.recursion(), frame.gpuScene().anchor(), &counts_));
    std::vector<TessellatedVertex> vertices;
    for (size_t i = 0; i < surface->positions.size(); ++i)
      vertices.push_back({surface->positions[i],
                          scene.parts[scene.surfaces.patches[surface->patches[i]].part].material,
                          surface->normals[i], kRungTangents});
    const gl::Buffer vertexBuffer(vertices), indexBuffer(surface->triangles);
    const SurfaceVertexArray array(vertexBuffer, indexBuffer);
    surface_ = surface;
    picture_->render(frame, [&] {
      drawProgram_->use();
      drawProgram_->set("anchorToClip", frame::anchorToClip(frame));
      array.bind();
      glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * surface->triangles.size()), GL_UNSIGNED_INT,
                     nullptr);
    });
  }

  const gl::Texture& product() const override { return picture_->texture(); }
  std::shared_ptr<const surfaces::TessellatedSurface> tessellation(frame::Frame&) override {
    return surface_;
  }

  std::vector<Counter> count(frame::Frame&) override {
    return {{"parts_tested", double(counts_.tests)},
            {"faces", double(counts_.faces)},
            {"tessellated_triangles", double(counts_.triangles)},
            {"tessellated_vertices", double(surface_->positions.size())},
            {"parts_culled", double(counts_.culled)},
            {"parts_cut_short", double(counts_.cutShort)},
            {"recursion_steps", double(counts_.steps)}};
  }

  static std::vector<Quantity> quantities() {
    const Direction lower = Direction::LowerIsBetter;
    return {{"parts_tested", "Parts tested", "parts", lower},
            {"faces", "Flat parts", "faces", lower},
            {"tessellated_triangles", "Triangles made", "triangles", lower},
            {"tessellated_vertices", "Vertices made", "vertices", lower},
            {"parts_culled", "Parts culled", "parts", Direction::Neither},
            {"parts_cut_short", "Parts drawn although not flat", "parts", lower},
            {"recursion_steps", "Splits from a patch to its smallest part", "steps", lower}};
  }

 private:
  Settings settings_;
  std::optional<SurfacePicture> picture_;
  const gl::Program* drawProgram_ = nullptr;
  std::shared_ptr<const surfaces::TessellatedSurface> surface_;
  surfaces::RecursionCounts counts_;
};

const RegisteredTechnique<CpuRecursion> kCpuRecursionRegistered{
    {.name = "recursion/cpu",
     .version = 2,
     .summary = "Curved surfaces split recursively until parts are flat on the screen, on the CPU",
     .source = "Schwarz 2009, section 7.2 (SC-37 to SC-43, SC-46)",
     .product = ProductKind::Colour,
     .needs = {"curved_surfaces"},
     .tessellates = true,
     .onCpu = true,
     .counters = CpuRecursion::quantities()}};

}  // namespace
}  // namespace limen::techniques
