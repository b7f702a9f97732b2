// SPDX-License-Identifier: BSD-3-Clause
// Tessellation on the fly in compute shaders, CudaTess of Schwarz 2009, section 7.6 (SC-69 to SC-71, 73, 77):
// factors, common factors and counts, prefix sums, vertices, indices, one indirect draw. Differences from the
// thesis:
// - The host reads no totals back to resize its buffers: they have a declared capacity, and patches that do
// not fit
//   are left out and counted.
// - With `patch_parallel` a power of two of invocations share a patch, as many as its vertices are worth,
// which
//   the GPU decides; `vertex_parallel` gives each vertex an invocation of its own, which finds its patch in
//   the offsets; `four_threads` is the thesis's form.
// - Geomorphing evaluates the coarser level's vertices again in place of a pass over the buffers.
// - Positions along sides are bitwise the same for both patches by the order of the sums (evaluate.glsl).
// - The corners of adjoining transitions are corrected by default, which also keeps the bound there.
#include <epoxy/gl.h>

#include <cmath>

#include "renderer/compute/prefix_sum.h"
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/compute/compute_settings.h"
#include "renderer/techniques/tessellation/compute/trim_pass.h"
#include "renderer/techniques/tessellation/depth_passes.h"
#include "renderer/techniques/tessellation/surface_picture.h"
#include "renderer/techniques/tessellation/surface_view.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"
#include "renderer/techniques/tessellation/vertex_feedback.h"

namespace limen::techniques {
namespace {

/// That occupy a GPU, of which an NVIDIA H200 runs 132 x 2048 at once, or a software renderer.
uint32_t manyInvocations(const gl::Context& context) {
  return context.device().software ? 1U << 8 : 1U << 18;
}

constexpr int64_t kIndicesPerVertex = 6;

/// Invocations that take one piece of work after another: enough to occupy the device twice; on a software
/// renderer also enough that none takes more than 1,024 of the `slots`, as its loops end after 65,535 rounds
/// in all.
int64_t workers(const gl::Context& context, int64_t slots) {
  const int64_t least = context.device().software ? slots / 1024 : 0;
  return std::max<int64_t>(2 * manyInvocations(context), least);
}

class ComputeTessellation : public Technique {
 public:
  using Settings = ComputeTessellationSettings;
  explicit ComputeTessellation(const Settings& settings) : settings_(settings) {}
  ~ComputeTessellation() override {
    if (instanceArray_) glDeleteVertexArrays(1, &instanceArray_);
  }

  void prepare(frame::Frame& frame) override {
    const std::string folder = "renderer/techniques/tessellation/compute/";
    const bool trimmed = !frame.scene().surfaces.trims.empty();
    patches_.emplace(frame.scene(), frame.gpuScene().anchor(),
                     DrawnSurfaces{.trimmed = true, .moving = true});
    if (trimmed) requireDriver();
    requireRectangles(frame.scene());
    requireInvocations();
    lists_ = !settings_.needsDriver() && !trimmed &&
             frame::chosenRaster(settings_.raster, frame.context()) == frame::Raster::Compute;
    factors_.emplace(frame, *patches_, settings_.tessellation, lists_, settings_.spacing);
    scan_.emplace(frame.context(), patches_->count(), 2, settings_.scan);
    picture_.emplace(frame, settings_.shading, "tessellation",
                     lists_ ? frame::Raster::Compute : frame::Raster::Hardware);
    gl::ShaderDefines defines = patches_->defines();
    if (settings_.vertexParallel()) defines["VERTEX_PARALLEL"] = "1";
    if (lists_) defines["LISTS"] = "1";
    defines["SPACING"] = std::to_string(static_cast<int>(settings_.spacing));
    if (settings_.byDifferences())
      defines["RESTART"] = std::to_string(std::get<EvaluateByDifferences>(settings_.evaluation).restart);
    if (settings_.sides == SharedSides::Copied) defines["COPIED"] = "1";
    gl::ProgramCache& programs = frame.context().programs();
    totalsProgram_ = &programs.compute(folder + "totals.comp.glsl", defines);
    if (settings_.scan == compute::ScanForm::Auto && patches_->count() <= uint32_t(kFewPatches)) {
      gl::ShaderDefines few = factors_->countDefines();
      few.merge(gl::ShaderDefines(defines));
      fewProgram_ = &programs.compute(folder + "few_patches.comp.glsl", few);
    }
    const bool inVertexShader = settings_.inVertexShader();
    verticesProgram_ = &programs.compute(folder + (inVertexShader            ? "pattern_instances.comp.glsl"
                                                   : settings_.fourThreads() ? "four_lanes.comp.glsl"
                                                                             : "vertices.comp.glsl"),
                                         defines);
    if (settings_.sides == SharedSides::Copied)
      copyProgram_ = &programs.compute(folder + "copy_sides.comp.glsl", defines);
    indicesProgram_ = &programs.compute(folder + "indices.comp.glsl", defines);
    gl::ShaderDefines drawDefines = inVertexShader ? patches_->defines() : gl::ShaderDefines();
    if (inVertexShader) drawDefines["INSTANCES"] = "1";
    if (trimmed) drawDefines["TRIMMED"] = "1";
    drawProgram_ =
        &programs.get({inVertexShader ? "renderer/techniques/tessellation/patterns/pattern.vert.glsl"
                                      : folder + "surface.vert.glsl",
                       "renderer/techniques/tessellation/surface.frag.glsl"},
                      drawDefines);
    if (settings_.passes > 1) otherPasses_.emplace(frame, "tessellation");
    offsets_.emplace(compute::PrefixSum::bytesFor(patches_->count(), 2), nullptr);
    totals_.emplace(int64_t{sizeof(TessellationTotals)}, nullptr);
    count_.emplace(int64_t{sizeof(frame::RasterCount)}, nullptr);
    capacity_ = settings_.capacity > 0 ? settings_.capacity : capacityFor(frame);
    vertices_.emplace(capacity_ * bytesPerVertex(), nullptr);
    // Written by four words.
    indices_.emplace((capacity_ * kIndicesPerVertex * 4 + 15) / 16 * 16, nullptr);
    makeVertexArray();
    if (trimmed) {
      trims_.emplace(frame, settings_.trims, defines, capacity_);
      array_->setTrimPlaces(trims_->places());
      frame.passes().setBytesHeld("tessellation/trims", trims_->bytes());
    }
    frame.passes().setBytesHeld("tessellation/factors", patches_->bytes() + factors_->bytes());
    frame.passes().setBytesHeld("tessellation/scan", offsets_->bytes() + totals_->bytes() + scan_->bytes());
    frame.passes().setBytesHeld("tessellation/vertices", vertices_->bytes());
    frame.passes().setBytesHeld("tessellation/indices", indices_->bytes());
  }

  void render(frame::Frame& frame) override {
    if (lists_) picture_->startMesh(frame);
    if (fewProgram_) {
      factors_->runFirst(frame);
      const auto scope = frame.passes().open("tessellation/counts");
      factors_->factors().bindStorage(kFactorsBuffer);
      fewProgram_->set("cornerFix", settings_.tessellation.cornerFix ? 1 : 0);
      makeTotals(frame, *fewProgram_);
    } else {
      factors_->run(frame);
      const auto scope = frame.passes().open("tessellation/scan");
      scan_->run(factors_->counts(), *offsets_, patches_->count());
      makeTotals(frame, *totalsProgram_);
    }
    patches_->bindStorage();
    factors_->factors().bindStorage(kFactorsBuffer);
    vertices_->bindStorage(kVerticesBuffer);
    indices_->bindStorage(kIndicesBuffer);
    fill(frame, *verticesProgram_, "tessellation/vertices");
    if (copyProgram_) copySides(frame);
    // Beside the vertices.
    fill(frame, *indicesProgram_, "tessellation/indices");
    if (lists_) picture_->finishMesh(frame);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    if (trims_) {
      trims_->run(frame, settings_.tessellation.cornerFix ? 1 : 0,
                  static_cast<int>(std::min(capacity_, workers(frame.context(), capacity_))));
    }
    if (lists_) {
      picture_->renderListed(frame, {*vertices_, *indices_, *count_, capacity_ * kIndicesPerVertex / 3});
      return;
    }
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT);
    const auto draw = [&] { drawSurface(frame); };
    if (otherPasses_) otherPasses_->render(frame, settings_.passes - 1, [&](int) { draw(); });
    picture_->render(frame, draw);
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::shared_ptr<const surfaces::TessellatedSurface> tessellation(frame::Frame& frame) override {
    const TessellationTotals totals = totals_->read<TessellationTotals>()[0];
    const std::vector<PatchFactors> factors = factors_->factors().read<PatchFactors>(0, patches_->count());
    auto out = std::make_shared<surfaces::TessellatedSurface>();
    out->anchor = frame.gpuScene().anchor();
    out->view = viewOf(frame);
    if (frame.scene().surfaces.motion.moves())
      out->moved =
          std::make_shared<surfaces::PatchSet>(surfaces::movedTo(frame.scene().surfaces, frame.timeS()));
    for (const TessellatedVertex& vertex : readVertices(frame, totals)) {
      out->positions.push_back(vertex.position);
      out->normals.push_back(vertex.normal);
    }
    out->triangles = readTriangles(totals);
    const std::vector<surfaces::Patch>& patches = frame.scene().surfaces.patches;
    for (uint32_t i = 0; i < patches.size(); ++i) {
      surfaces::Factors& own = out->factors.emplace_back();
      if (i >= totals.patches || factors[i].segments == 0) continue;
      for (uint32_t side = 0; side < 4; ++side)
        own[side] = static_cast<int>(factors[i].segments >> 8 * side & 255U);
      const surfaces::ivec4 units(factors[i].first & 65535U, factors[i].first >> 16,
                                  factors[i].second & 65535U, factors[i].second >> 16);
      const surfaces::PatternPlan plan =
          surfaces::patternOf(patches[i].domain, own, settings_.tessellation.cornerFix);
      for (int slot = 0; slot < plan.vertices; ++slot) {
        out->parameters.push_back(
            surfaces::spacedPointOf(plan, slot, static_cast<int>(settings_.spacing), units));
        out->patches.push_back(i);
      }
    }
    return out;
  }

  std::vector<Counter> count(frame::Frame& frame) override {
    const TessellationTotals totals = totals_->read<TessellationTotals>()[0];
    const std::vector<PatchFactors> factors = factors_->factors().read<PatchFactors>(0, patches_->count());
    const std::vector<TessellatedVertex> vertices = readVertices(frame, totals);
    double culled = 0.0, rungs[kRungs] = {};
    for (const PatchFactors& of : factors) culled += of.segments == 0;
    for (const TessellatedVertex& vertex : vertices) rungs[vertex.rung] += 1.0;
    std::vector<Counter> out = {
        {"patches_culled", culled},
        {"patches_capped", double(factors_->countCapped(frame))},
        {"patches_left_out", double(totals.overflow)},
        {"tessellated_vertices", double(totals.vertices)},
        {"tessellated_triangles", double(readTriangles(totals).size())},
        {"tessellated_indices", double(totals.indices)},
        {"tessellated_mib",
         (double(totals.vertices) * double(bytesPerVertex()) + 4.0 * double(totals.indices)) / 1048576.0},
        {"degenerate_normals", rungs[kRungInward] + rungs[kRungCornerPlane] + rungs[kRungNone]},
        {"normals_from_corners", rungs[kRungCornerPlane]},
        {"normals_none", rungs[kRungNone]}};
    if (trims_) out.push_back({"trim_error", trims_->error()});
    return out;
  }

  static std::vector<Quantity> quantities() {
    return {
        {"patches_culled", "Patches culled", "patches", Direction::Neither},
        {"patches_capped", "Patches that more segments than allowed would be needed for", "patches",
         Direction::LowerIsBetter},
        {"patches_left_out", "Patches left out for want of capacity", "patches", Direction::LowerIsBetter},
        {"tessellated_vertices", "Vertices made", "vertices", Direction::LowerIsBetter},
        {"tessellated_triangles", "Triangles made", "triangles", Direction::LowerIsBetter},
        {"tessellated_indices", "Indices made", "indices", Direction::LowerIsBetter},
        {"tessellated_mib", "Vertices and indices", "MiB", Direction::LowerIsBetter},
        {"degenerate_normals", "Normals not given by the derivatives", "vertices", Direction::LowerIsBetter},
        {"normals_from_corners", "Normals taken from a patch's corners", "vertices",
         Direction::LowerIsBetter},
        {"normals_none", "Vertices without a normal", "vertices", Direction::LowerIsBetter},
        {"trim_error", "Share of a surface's domain where its texture contradicts its curves, largest", "",
         Direction::LowerIsBetter}};
  }

 private:
  int64_t bytesPerVertex() const {
    return settings_.inVertexShader() ? sizeof(glm::uvec2) : sizeof(TessellatedVertex);
  }

  std::vector<glm::uvec3> readTriangles(const TessellationTotals& totals) const {
    if (lists_) return indices_->read<glm::uvec3>(0, totals.indices / 3);
    return surfaces::stripTriangles(indices_->read<uint32_t>(0, totals.indices));
  }

  void makeVertexArray() {
    if (!settings_.inVertexShader()) {
      array_.emplace(*vertices_, *indices_);
      return;
    }
    glCreateVertexArrays(1, &instanceArray_);
    glVertexArrayAttribIFormat(instanceArray_, 0, 2, GL_UNSIGNED_INT, 0);
    glVertexArrayAttribBinding(instanceArray_, 0, 0);
    glEnableVertexArrayAttrib(instanceArray_, 0);
    glVertexArrayVertexBuffer(instanceArray_, 0, vertices_->id(), 0, sizeof(glm::uvec2));
    glVertexArrayElementBuffer(instanceArray_, indices_->id());
  }

  /// Of the last frame, in the order of slots. Waits for the GPU.
  std::vector<TessellatedVertex> readVertices(frame::Frame& frame, const TessellationTotals& totals) const {
    if (!settings_.inVertexShader()) return vertices_->read<TessellatedVertex>(0, totals.vertices);
    const VertexFeedback feedback(std::max(totals.vertices, 1U));
    gl::ShaderDefines defines = patches_->defines();
    defines["INSTANCES"] = "1";
    defines["CAPTURE"] = "1";
    const gl::Program& program =
        frame.context().programs().get({"renderer/techniques/tessellation/patterns/pattern.vert.glsl",
                                        "renderer/techniques/tessellation/surface.frag.glsl"},
                                       defines);
    bindSurface(frame, program);
    glEnable(GL_RASTERIZER_DISCARD);
    feedback.capture(GL_POINTS, [&] { glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(totals.vertices)); });
    glDisable(GL_RASTERIZER_DISCARD);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    return feedback.vertices().read<TessellatedVertex>(0, totals.vertices);
  }

  void bindSurface(frame::Frame& frame, const gl::Program& program) const {
    program.use();
    program.set("anchorToClip", frame::anchorToClip(frame));
    if (array_) {
      array_->bind();
      if (trims_ && &program == drawProgram_) {
        trims_->bindTexture();
        program.set("leastLeft", settings_.trims.content == surfaces::TrimTexture::Inside ? 0.5F : 0.0F);
      }
    } else {
      patches_->bindStorage();
      glBindVertexArray(instanceArray_);
    }
  }

  void drawSurface(frame::Frame& frame) const {
    bindSurface(frame, *drawProgram_);
    glEnable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, totals_->id());
    glDrawElementsIndirect(GL_TRIANGLE_STRIP, GL_UNSIGNED_INT,
                           reinterpret_cast<const void*>(offsetof(TessellationTotals, indices)));
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    glDisable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
  }

  /// Waits for the GPU.
  int64_t capacityFor(frame::Frame& frame) {
    factors_->run(frame);
    scan_->run(factors_->counts(), *offsets_, patches_->count());
    const auto needed = offsets_->read<glm::uvec2>(int64_t{patches_->count()} * sizeof(glm::uvec2), 1)[0];
    const int64_t slots = int64_t{needed.y} * (lists_ ? 3 : 1);
    const int64_t vertices = std::max<int64_t>(needed.x, (slots + kIndicesPerVertex - 1) / kIndicesPerVertex);
    return std::clamp<int64_t>(2 * vertices, 1024, kMostVertices);
  }

  void makeTotals(frame::Frame& frame, const gl::Program& program) const {
    offsets_->bindStorage(kSlotOffsetsBuffer);
    totals_->bindStorage(kTotalsBuffer);
    count_->bindStorage(kTriangleCountBuffer);
    program.use();
    program.set("patchCount", patches_->count());
    program.set("vertexCapacity", static_cast<uint32_t>(capacity_));
    program.set("indexCapacity", static_cast<uint32_t>(capacity_ * kIndicesPerVertex));
    program.set("indicesPerSlot", lists_ ? 3U : 1U);
    if (!settings_.vertexParallel()) setLanes(frame.context(), program);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  }

  void setLanes(const gl::Context& context, const gl::Program& program) const {
    const auto* patchParallel = std::get_if<PatchParallel>(&settings_.form);
    const auto given = static_cast<uint32_t>(patchParallel ? patchParallel->lanes : 0);
    program.set("lanes", settings_.fourThreads() ? 4U : given);
    program.set("indexLanes", given);
    program.set("manyInvocations", manyInvocations(context));
    program.set("verticesPerInvocation", static_cast<uint32_t>(patchParallel ? patchParallel->verticesEach
                                                                             : PatchParallel{}.verticesEach));
  }

  void fill(frame::Frame& frame, const gl::Program& program, const char* pass) {
    const auto scope = frame.passes().open(pass);
    program.use();
    program.set("cornerFix", settings_.tessellation.cornerFix ? 1 : 0);
    if (settings_.fourThreads() && &program == verticesProgram_) {
      dispatchPatches(4);
    } else {
      // For the most invocations that a patch may have, but no more than occupy the device twice.
      const int64_t most = settings_.vertexParallel() ? capacity_ * kIndicesPerVertex
                                                      : int64_t{patches_->count()} * kMostLanes;
      program.dispatch(
          {static_cast<int>(std::min(most, workers(frame.context(), capacity_ * kIndicesPerVertex))), 1},
          {kTessellationGroup, 1});
    }
  }

  void dispatchPatches(uint32_t perPatch) const {
    const uint32_t groups =
        (patches_->count() * perPatch + uint32_t(kTessellationGroup) - 1) / uint32_t(kTessellationGroup);
    const uint32_t rows = (groups + 65534) / 65535;
    glDispatchCompute((groups + rows - 1) / rows, rows, 1);
  }

  void copySides(frame::Frame& frame) {
    const auto scope = frame.passes().open("tessellation/sides");
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    copyProgram_->use();
    copyProgram_->set("cornerFix", settings_.tessellation.cornerFix ? 1 : 0);
    dispatchPatches(4);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }

  void requireInvocations() const {
    const auto* of = std::get_if<PatchParallel>(&settings_.form);
    if (of && int64_t{of->lanes} * patches_->count() > 1LL << 31)
      throw Error("too many invocations for " + std::to_string(patches_->count()) + " patches", "form.lanes",
                  "use fewer, or 0");
  }

  void requireDriver() const {
    if (settings_.raster == frame::Raster::Compute)
      throw Error("trimmed surfaces are for the driver's rasteriser", "raster", "use raster: hardware");
    if (settings_.inVertexShader())
      throw Error("trimmed surfaces take vertices that are stored", "evaluation",
                  "use evaluation: direct or forward_differences");
  }

  void requireRectangles(const scene::Scene& scene) const {
    if (!isFractional(settings_.spacing)) return;
    for (const surfaces::Patch& patch : scene.surfaces.patches)
      if (patch.domain == surfaces::Domain::Triangle)
        throw Error("fractional spacing is for rectangular patches", "spacing", "use spacing: geomorph");
  }

  Settings settings_;
  std::optional<PatchBuffers> patches_;
  std::optional<FactorPass> factors_;
  std::optional<compute::PrefixSum> scan_;
  std::optional<SurfacePicture> picture_;
  const gl::Program *totalsProgram_ = nullptr, *verticesProgram_ = nullptr, *indicesProgram_ = nullptr,
                    *drawProgram_ = nullptr, *copyProgram_ = nullptr,
                    *fewProgram_ = nullptr;  // where there are no more than kFewPatches
  std::optional<gl::Buffer> offsets_, totals_, count_, vertices_, indices_;
  bool lists_ = false;    // indices of single triangles, for ComputeRaster; otherwise strips
  int64_t capacity_ = 0;  // vertices
  std::optional<TrimPass> trims_;
  std::optional<DepthPasses> otherPasses_;
  std::optional<SurfaceVertexArray> array_;
  uint32_t instanceArray_ = 0;  // evaluation in the vertex shader
};

struct UniformFineSettings {
  int segments = 64;
  frame::ShadedSetting shading;
  static const SettingsTable<UniformFineSettings>& table() {
    using S = UniformFineSettings;
    static const SettingsTable<S> kTable = {
        {&S::segments, "segments", {1, 64}, "segments", "Segments of every side"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

/// Reference: so fine a tessellation that its deviation is a small part of a pixel.
class UniformFine : public Technique {
 public:
  using Settings = UniformFineSettings;
  explicit UniformFine(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    ComputeTessellationSettings all;
    all.tessellation.factors = BySegments{settings_.segments};
    const int64_t side = settings_.segments + 1,
                  patches = static_cast<int64_t>(frame.scene().surfaces.patches.size());
    all.capacity = std::max<int64_t>(patches * side * side, 4);
    if (all.capacity > kMostVertices)
      throw Error(
          std::to_string(patches) + " patches with " + std::to_string(settings_.segments) + " segments are " +
              std::to_string(all.capacity) + " vertices, more than the " + std::to_string(kMostVertices) +
              " that buffers take",
          "segments",
          "use at most " + std::to_string(int(std::sqrt(double(kMostVertices) / double(patches))) - 1));
    all.shading = settings_.shading;
    fine_.emplace(all);
    fine_->prepare(frame);
  }
  void render(frame::Frame& frame) override { fine_->render(frame); }
  const gl::Texture& product() const override { return fine_->product(); }
  std::shared_ptr<const surfaces::TessellatedSurface> tessellation(frame::Frame& frame) override {
    return fine_->tessellation(frame);
  }
  std::vector<Counter> count(frame::Frame& frame) override { return fine_->count(frame); }

 private:
  Settings settings_;
  std::optional<ComputeTessellation> fine_;
};

const RegisteredTechnique<UniformFine> kUniformFineRegistered{
    {.name = "tessellation/uniform_fine",
     .version = 2,
     .summary = "Curved surfaces with the same fine tessellation of all patches",
     .source = "bench",
     .product = ProductKind::Colour,
     .needs = {"curved_surfaces"},
     .reference = true,
     .tessellates = true,
     .counters = ComputeTessellation::quantities()}};

const RegisteredTechnique<ComputeTessellation> kComputeTessellationRegistered{
    {.name = "tessellation/compute",
     .version = 2,
     .summary = "Curved surfaces tessellated on the fly in compute shaders (CudaTess)",
     .source = "Schwarz 2009, section 7.6 (SC-69)",
     .product = ProductKind::Colour,
     .needs = {"curved_surfaces"},
     .tessellates = true,
     .counters = ComputeTessellation::quantities()}};

}  // namespace
}  // namespace limen::techniques
