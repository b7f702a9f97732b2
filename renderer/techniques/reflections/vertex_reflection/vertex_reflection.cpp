// SPDX-License-Identifier: BSD-3-Clause
// Mirrors by reflection of vertices (Roger 2008, chapter 2): each vertex of the scene is moved to the point
// of the reflector where the eye sees it, and triangles are drawn between these points.
//
// Departures from the thesis, whose own form stays a choice: the search starts from a triangle around the
// eye's projection and ends by the longest side of the samples' triangle at 1e-4 px^2. The thesis' own start
// (projections of vertex and eye) leads some 4 % of the searches to the reflector's far side, and its end (an
// area of 1 px^2) stops where the triangle is merely thin or seen edge-on: near silhouettes the points are
// then pixels off (experiments/descriptors/reflections/vertex_reflection_search.yaml).
//
// Others: the gradient is corrected (see secant_solver.cpp; the printed forms are
// variants); vertices without a reflection are recognised and their triangles treated as `invalid` says;
// searches that wander start again (`safeguard`); pixels of the reflector are told by their triangle instead
// of a stencil bit, which does the same; PreviousFrame starts from a small triangle around the point found a
// frame ago instead of all three last samples.
#include <epoxy/gl.h>

#include <optional>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/mirror_rays.h"
#include "renderer/frame/moved_vertices.h"
#include "renderer/techniques/reflections/moving_mirrors.h"
#include "renderer/techniques/reflections/reflection_picture.h"
#include "renderer/techniques/reflections/vertex_reflection/far_environment.h"
#include "renderer/techniques/reflections/vertex_reflection/reflected_mesh.h"
#include "renderer/techniques/reflections/vertex_reflection/reflection_counts.h"
#include "renderer/techniques/reflections/vertex_reflection/reflector.h"
#include "renderer/techniques/reflections/vertex_reflection/vertex_reflection_bindings.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

const std::string kVertexReflectionFolder = "renderer/techniques/reflections/vertex_reflection/";
constexpr const char* kMoveReflectedPass = "reflections/move_vertices";
constexpr const char* kSolvePass = "reflections/solve_vertices";
constexpr const char* kBacksPass = "reflections/back_faces";
constexpr const char* kFarPass = "reflections/far_environment";
constexpr const char* kDrawPass = "reflections/draw_reflected";
constexpr int kMostGroups = 65535;  // in a dimension
/// llvmpipe (Mesa 22.3) draws wrong triangles if one draw evaluates more vertices.
constexpr int kReflectedPerSoftwareDraw = 65536;

class VertexReflection : public Technique {
 public:
  using Settings = VertexReflectionSettings;
  explicit VertexReflection(const Settings& settings) : settings_(settings), picture_(settings.shading) {
    adaptive_ = std::get_if<AdaptiveSegments>(&settings_.tessellation);
    far_ = std::get_if<FarSurroundings>(&settings_.surroundings);
  }
  ~VertexReflection() override {
    if (vertexArray_) glDeleteVertexArrays(1, &vertexArray_);
  }

  void prepare(frame::Frame& frame) override {
    checkMotion(frame);
    const int segments =
        adaptive_ ? adaptive_->segments : std::get<EvenSegments>(settings_.tessellation).segments;
    mesh_ = reflections::divided(frame.scene().mesh, segments, frame.gpuScene().anchor());
    positions_.emplace(mesh_.positions);
    indices_.emplace(mesh_.triangles);
    sources_.emplace(mesh_.sources);
    reflectors_ = makeReflectors(frame.scene(), settings_.map, mesh_, frame.shownMirrors());
    ranges_.clear();
    for (const StarReflector& reflector : reflectors_) {
      ranges_.push_back(std::make_unique<frame::TriangleRanges>(1));
      ranges_.back()->set({reflector.triangles});
    }
    prepareMotion(frame);
    makeVertexArray();
    compile(frame);
    prepareFar(frame);
    reflected_.emplace(gl::Format::RGBA32F, frame.sizePx());
    depth_.emplace(gl::Format::Depth32F, frame.sizePx());
    target_ = std::make_unique<gl::Framebuffer>(std::vector<const gl::Texture*>{&*reflected_}, &*depth_);
    backs_.emplace(gl::Format::Depth32F, frame.sizePx());
    backTarget_ = std::make_unique<gl::Framebuffer>(std::vector<const gl::Texture*>{}, &*backs_);
    int64_t solved = positions_->bytes();
    for (const StarReflector& reflector : reflectors_)
      solved += reflector.reflected.bytes() + reflector.map.bytes();
    if (settings_.placement == Placement::Compute) frame.passes().setBytesHeld(kSolvePass, solved);
    if (settings_.hideBehindBacks) frame.passes().setBytesHeld(kBacksPass, backs_->bytes());
    frame.passes().setBytesHeld(
        kDrawPass, reflected_->bytes() + depth_->bytes() + indices_->bytes() + sources_->bytes());
    picture_.prepare(frame);
  }

  void render(frame::Frame& frame) override {
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    if (moved_) {
      const auto scope = frame.passes().open(kMoveReflectedPass);
      moved_->update(frame.timeS());
    }
    if (settings_.placement == Placement::Compute) solveVertices(frame);
    if (settings_.hideBehindBacks) drawBacks(frame);
    {
      const auto scope = frame.passes().open(kDrawPass);
      target_->bind();
      const glm::vec4 nothing(0.0F);
      constexpr GLfloat kFar = 1.0F;
      glClearBufferfv(GL_COLOR, 0, &nothing.x);
      glClearBufferfv(GL_DEPTH, 0, &kFar);
      glEnable(GL_DEPTH_TEST);
      glDepthFunc(GL_LESS);
      glDisable(GL_CULL_FACE);
      frame::configureShading(*draw_, frame, settings_.shading);
      backs_->bindTexture(kReflectorBacksUnit);
      ids.bindTexture(kReflectorIdsUnit);
      sources_->bindStorage(kReflectedSourcesBuffer);
      for (const StarReflector& reflector : reflectors_) drawReflected(frame, *draw_, reflector);
      glDisable(GL_DEPTH_TEST);
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    }
    if (far_) addFar(frame);
    picture_.compose(frame, *reflected_);
  }

  const gl::Texture& product() const override { return picture_.texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    ReflectionStatistics statistics;
    if (moved_) mesh_.positions = moved_->positions().read<glm::vec3>(0, int64_t(mesh_.positions.size()));
    for (const StarReflector& reflector : reflectors_) {
      solveForCounting(frame, reflector);
      statistics.add(reflector, mesh_, frame, settings_.solver, reflector.reflected.read<glm::vec4>());
    }
    if (adaptive_) statistics.setTessellated(countTessellated(frame));
    return statistics.counters();
  }

  std::vector<std::string> remarks() const override {
    std::vector<std::string> out;
    for (const StarReflector& reflector : reflectors_)
      if (reflector.filledShare > 0.0)
        out.push_back("A mirror is open: " + std::to_string(static_cast<int>(100.0 * reflector.filledShare)) +
                      " % of its map's texels were filled from their neighbours.");
    return out;
  }

 private:
  /// Maps of mirrors and of what is far are made once.
  void checkMotion(const frame::Frame& frame) const {
    if (frame.scene().motions.empty()) return;
    refuseMovingMirrors(frame, "vertex reflection needs mirrors at rest");
    if (far_)
      throw Error("a map of the far surroundings is made once, and parts of the scene move", "surroundings",
                  "leave out the map");
  }

  void prepareMotion(frame::Frame& frame) {
    const scene::Scene& scene = frame.scene();
    if (scene.motions.empty()) return;
    std::vector<uint32_t> motionOf(mesh_.positions.size(), 0);
    for (size_t i = 0; i < scene.motions.size(); ++i) {
      const scene::Part& part = scene.parts[scene.motions[i].part];
      const size_t per = static_cast<size_t>(mesh_.perTriangle), first = part.firstTriangle * per;
      for (size_t t = first; t < first + part.triangleCount * per; ++t)
        for (int corner = 0; corner < 3; ++corner)
          motionOf[mesh_.triangles[t][corner]] = static_cast<uint32_t>(i + 1);
    }
    moved_.emplace(frame.context(), scene.motions, frame.gpuScene().anchor(), *positions_, nullptr, motionOf);
    frame.passes().setBytesHeld(kMoveReflectedPass, moved_->bytes());
  }

  const gl::Buffer& reflectedPositions() const { return moved_ ? moved_->positions() : *positions_; }

  void makeVertexArray() {
    glCreateVertexArrays(1, &vertexArray_);
    glVertexArrayAttribFormat(vertexArray_, 0, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(vertexArray_, 0, 0);
    glEnableVertexArrayAttrib(vertexArray_, 0);
    glVertexArrayVertexBuffer(vertexArray_, 0, reflectedPositions().id(), 0, sizeof(glm::vec3));
    glVertexArrayElementBuffer(vertexArray_, indices_->id());
  }

  void compile(frame::Frame& frame) {
    gl::ProgramCache& programs = frame.context().programs();
    gl::ShaderDefines defines = secantDefines(settings_.solver, settings_.map);
    defineEnum(defines, "POLICY", settings_.invalid);
    solve_ = &programs.compute(kVertexReflectionFolder + "solve_vertices.comp.glsl", defines);
    backProgram_ = &programs.get(
        {"renderer/frame/triangle_ids.vert.glsl", kVertexReflectionFolder + "back_faces.frag.glsl"});
    if (settings_.placement == Placement::VertexShader) defines["IN_VERTEX_SHADER"] = "1";
    if (adaptive_) defines["TESSELLATED"] = "1";
    std::vector<std::string> stages = {kVertexReflectionFolder + "reflected.vert.glsl"};
    if (adaptive_)
      for (const char* name : {"reflected.tesc.glsl", "reflected.tese.glsl"})
        stages.push_back(kVertexReflectionFolder + name);
    if (adaptive_) {
      gl::ShaderDefines counting = defines;
      counting["COUNT"] = "1";
      std::vector<std::string> counted = stages;
      counted.push_back(kVertexReflectionFolder + "nothing.frag.glsl");
      countDraw_ = &programs.get(counted, counting);
    }
    stages.push_back(kVertexReflectionFolder + "reflected.frag.glsl");
    for (const auto& [name, value] : shadingDefines(settings_.shading, frame)) defines[name] = value;
    if (settings_.hideBehindBacks) defines["HIDE_BEHIND_BACKS"] = "1";
    if (settings_.depth == PathDepth::Fragments) defines["DEPTH_OF_FRAGMENT"] = "1";
    if (settings_.litFrom == LitFrom::Eye) defines["LIT_AS_FROM_EYE"] = "1";
    draw_ = &programs.get(stages, defines);
  }

  void prepareFar(frame::Frame& frame) {
    if (!far_) return;
    farProgram_ = &frame.context().programs().compute(kVertexReflectionFolder + "far_environment.comp.glsl");
    environments_.clear();
    int64_t bytes = 0;
    for (const StarReflector& reflector : reflectors_) {
      environments_.emplace_back(frame, reflector, *far_, settings_.shading);
      bytes += environments_.back().bytes();
    }
    frame.passes().setBytesHeld(kFarPass, bytes);
  }

  void addFar(frame::Frame& frame) {
    const gl::Texture& directions = frame.get<frame::MirrorRays>().directions();
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    const auto scope = frame.passes().open(kFarPass);
    directions.bindTexture(kFarDirectionsUnit);
    ids.bindTexture(kReflectorIdsUnit);
    reflected_->bindImage(kFarImage, gl::Access::ReadWrite);
    farProgram_->set("sizePx", frame.sizePx());
    for (size_t i = 0; i < reflectors_.size(); ++i) {
      farProgram_->set("reflectorFirst", reflectors_[i].triangles.first);
      farProgram_->set("reflectorCount", reflectors_[i].triangles.count);
      environments_[i].bindTexture(kFarEnvironmentUnit);
      farProgram_->dispatch(frame.sizePx());
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  /// Vertex shaders keep nothing to be counted. A search from the previous frame is counted as if the eye had
  /// been a hundredth of its distance aside then, whether or not the scene's camera moves.
  void solveForCounting(frame::Frame& frame, const StarReflector& reflector) {
    if (settings_.solver.guess == reflections::FirstGuess::PreviousFrame) {
      const glm::dvec3 towards = frame.camera().eye - reflector.centre.position;
      const glm::dvec3 aside = glm::cross(towards, frame.camera().up);
      const double length = glm::length(aside);
      reflector.reflected.clearUint(0);
      solve(frame, reflector, length > 0.0 ? 0.01 * glm::length(towards) / length * aside : aside);
      solve(frame, reflector);
    } else if (settings_.placement == Placement::VertexShader) {
      solve(frame, reflector);
    }
  }

  void solve(frame::Frame& frame, const StarReflector& reflector, glm::dvec3 eyeOffset = glm::dvec3(0.0)) {
    configureSecant(*solve_, frame, settings_.solver, reflector, eyeOffset);
    reflectedPositions().bindStorage(kReflectedPositionsBuffer);
    reflector.reflected.bindStorage(kReflectedVerticesBuffer);
    const auto [ownFirst, ownCount] = reflector.ownVertices;
    solveRange(0, ownFirst);
    solveRange(ownFirst + ownCount, static_cast<uint32_t>(mesh_.positions.size()));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }

  void solveRange(uint32_t from, uint32_t to) const {
    if (from >= to) return;
    solve_->set("firstVertex", from);
    solve_->set("endVertex", to);
    const auto groups = static_cast<int>((to - from + kVertexGroup - 1) / kVertexGroup);
    solve_->dispatch({std::min(groups, kMostGroups) * kVertexGroup, (groups + kMostGroups - 1) / kMostGroups},
                     {kVertexGroup, 1});
  }

  void solveVertices(frame::Frame& frame) {
    const auto scope = frame.passes().open(kSolvePass);
    for (const StarReflector& reflector : reflectors_) solve(frame, reflector);
  }

  void drawBacks(frame::Frame& frame) {
    const auto scope = frame.passes().open(kBacksPass);
    backTarget_->bind();
    constexpr GLfloat kFar = 0.0F;  // reversed depth
    glClearBufferfv(GL_DEPTH, 0, &kFar);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDisable(GL_CULL_FACE);
    backProgram_->use();
    backProgram_->set("anchorToClip", frame::anchorToClip(frame));
    backProgram_->set("eyeRelative", glm::vec3(frame.camera().eye - frame.gpuScene().anchor()));
    frame.gpuScene().bindStorage();
    for (const auto& ranges : ranges_) frame.gpuScene().draw(ranges.get());
    glDisable(GL_DEPTH_TEST);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  void drawReflected(frame::Frame& frame, const gl::Program& program, const StarReflector& reflector) {
    configureSecant(program, frame, settings_.solver, reflector);
    program.set("anchorToClip", frame::anchorToClip(frame));
    program.set("reflectorFirst", reflector.triangles.first);
    program.set("reflectorCount", reflector.triangles.count);
    // No point of the scene is farther from the mirror than its bounds are wide.
    program.set("farthest", static_cast<float>(std::max(frame.gpuScene().diagonal(), 1e-30)));
    program.set("backSlack", static_cast<float>(settings_.backSlack));
    const double start = far_ ? far_->distance * reflector.centre.meanRadius : 0.0;
    program.set("farFade",
                far_ ? glm::vec2(glm::dvec2(start, start * (1.0 + far_->blend))) : glm::vec2(0.0F));
    program.set("fadeCentre", glm::vec3(reflector.centre.position - frame.gpuScene().anchor()));
    if (adaptive_) {
      program.set("tolerancePx", static_cast<float>(adaptive_->tolerancePx));
      program.set("mostSegments", adaptive_->most);
    }
    reflector.reflected.bindStorage(kReflectedVerticesBuffer);
    program.use();
    glBindVertexArray(vertexArray_);
    const auto total = static_cast<uint32_t>(mesh_.triangles.size());
    const auto per = static_cast<uint32_t>(mesh_.perTriangle);
    const uint32_t first = reflector.triangles.first * per, end = first + reflector.triangles.count * per;
    drawRange(frame, program, 0, first);
    drawRange(frame, program, end, total);
  }

  void drawRange(frame::Frame& frame, const gl::Program& program, uint32_t from, uint32_t to) const {
    uint32_t atOnce = to - from;
    if (adaptive_) {
      glPatchParameteri(GL_PATCH_VERTICES, 3);
      const int each = (adaptive_->most + 3) * (adaptive_->most + 3);
      if (frame.context().device().software)
        atOnce = static_cast<uint32_t>(std::max(1, kReflectedPerSoftwareDraw / each));
    }
    for (uint32_t at = from; at < to; at += atOnce) {
      const uint32_t count = std::min(atOnce, to - at);
      program.set("firstTriangle", at);
      glDrawElements(adaptive_ ? GL_PATCHES : GL_TRIANGLES, static_cast<GLsizei>(3 * count), GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(static_cast<uintptr_t>(at) * sizeof(glm::uvec3)));
    }
  }

  ReflectionCounts countTessellated(frame::Frame& frame) {
    const gl::Buffer counts(sizeof(ReflectionCounts), nullptr);
    counts.clearUint(0);
    glEnable(GL_RASTERIZER_DISCARD);
    counts.bindStorage(kReflectionCountsBuffer);
    for (const StarReflector& reflector : reflectors_) drawReflected(frame, *countDraw_, reflector);
    glDisable(GL_RASTERIZER_DISCARD);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    return counts.read<ReflectionCounts>().at(0);
  }

  Settings settings_;
  const AdaptiveSegments* adaptive_ = nullptr;
  const FarSurroundings* far_ = nullptr;
  std::vector<FarEnvironment> environments_;
  const gl::Program* farProgram_ = nullptr;
  ReflectionPicture picture_;
  reflections::ReflectedMesh mesh_;
  std::optional<gl::Buffer> positions_, indices_, sources_;
  std::optional<frame::MovedVertices> moved_;
  std::vector<StarReflector> reflectors_;
  std::vector<std::unique_ptr<frame::TriangleRanges>> ranges_;
  uint32_t vertexArray_ = 0;
  const gl::Program *solve_ = nullptr, *draw_ = nullptr, *countDraw_ = nullptr, *backProgram_ = nullptr;
  std::optional<gl::Texture> reflected_, depth_, backs_;
  std::unique_ptr<gl::Framebuffer> target_, backTarget_;
};

const RegisteredTechnique<VertexReflection> kVertexReflectionRegistered{
    {.name = "reflections/vertex_reflection",
     .version = 1,
     .summary = "Mirrors by drawing the scene's triangles between the reflection points of their vertices",
     .source = "Roger 2008, chapter 2 (R-01 to R-12)",
     .product = ProductKind::Colour,
     .needs = {"mirrors"},
     .followsMotion = true,
     .counters = ReflectionStatistics::quantities()}};

}  // namespace
}  // namespace limen::techniques
