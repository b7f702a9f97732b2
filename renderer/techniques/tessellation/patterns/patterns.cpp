// SPDX-License-Identifier: BSD-3-Clause
// Refinement patterns: tessellations of the domain stored as meshes, whose vertex shader evaluates patches
// (SC-60, SC-65 to SC-67). Factors and evaluation are those of tessellation/compute, so that both draw the
// same triangles. Differences from the thesis:
// - With `immediate` and `instanced` the host reads the factors, which the thesis computes there.
// - `multi_draw` builds batches on the GPU and reads nothing back; it needs a set of patterns that is known
// before.
#include <epoxy/gl.h>

#include <set>

#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/depth_passes.h"
#include "renderer/techniques/tessellation/patterns/pattern_batches.h"
#include "renderer/techniques/tessellation/patterns/pattern_settings.h"
#include "renderer/techniques/tessellation/patterns/pixel_evaluation.h"
#include "renderer/techniques/tessellation/surface_picture.h"
#include "renderer/techniques/tessellation/vertex_feedback.h"

namespace limen::techniques {
namespace {

/// Of the sides that a patch of this domain has; 0 for the rest.
surfaces::Factors factorsOf(uint32_t packed, surfaces::Domain domain) {
  surfaces::Factors out{};
  for (uint32_t side = 0; side < static_cast<uint32_t>(surfaces::sidesOf(domain)); ++side)
    out[side] = static_cast<int>(packed >> 8 * side & 255U);
  return out;
}

class RefinementPatterns : public Technique {
 public:
  using Settings = PatternSettings;
  explicit RefinementPatterns(const Settings& settings) : settings_(settings) {}
  ~RefinementPatterns() override {
    if (vertexArray_) glDeleteVertexArrays(1, &vertexArray_);
  }

  void prepare(frame::Frame& frame) override {
    const std::string folder = "renderer/techniques/tessellation/";
    patches_.emplace(frame.scene(), frame.gpuScene().anchor());
    factors_.emplace(frame, *patches_, settings_.tessellation, false,
                     settings_.dyadic() ? Spacing::Dyadic : Spacing::Integer);
    picture_.emplace(frame, settings_.shading, "tessellation");
    meshes_.emplace(settings_.capacity, settings_.tessellation.cornerFix);
    gl::ShaderDefines defines = patches_->defines();
    if (settings_.adapted()) defines["ADAPTED"] = "1";
    program_ = &frame.context().programs().get(
        {folder + "patterns/pattern.vert.glsl", folder + "surface.frag.glsl"}, defines);
    for (const surfaces::Patch& patch : frame.scene().surfaces.patches) domains_.push_back(patch.domain);
    if (settings_.draw == PatternDraw::MultiDraw) {
      batches_.emplace(frame, *patches_, *meshes_, settings_.most(), settings_.adapted());
    } else {
      instances_.emplace(int64_t{patches_->count()} * 4, nullptr);
    }
    if (settings_.coarseFirst) prepareCoarse(frame, defines);
    if (settings_.passes > 1) otherPasses_.emplace(frame, "tessellation");
    if (settings_.reuse == PatternReuse::Soup) prepareSoup(frame, defines);
    if (settings_.evaluation == PatternEvaluation::Pixel) {
      pixels_.emplace(frame, 2 * trianglesOfFirstView(frame) + kEvaluationTexels, defines);
      places_.emplace(int64_t{patches_->count()} * 4, nullptr);
      frame.passes().setBytesHeld("tessellation/vertices", pixels_->bytes() + places_->bytes());
    }
    makeVertexArray(batches_ ? batches_->instances() : *instances_);
    frame.passes().setBytesHeld("tessellation/factors", patches_->bytes() + factors_->bytes());
    frame.passes().setBytesHeld("tessellation/batches", batches_ ? batches_->bytes() : instances_->bytes());
    frame.passes().setBytesHeld("tessellation/patterns",
                                meshes_->samples().bytes() + meshes_->indices().bytes());
  }

  void render(frame::Frame& frame) override {
    factors_->run(frame);
    {
      const auto scope = frame.passes().open("tessellation/batches");
      if (batches_) {
        batches_->run(*factors_);
      } else {
        buildBatches();
      }
    }
    if (pixels_) evaluatePixels(frame);
    const auto pass = [&](int number) {
      if (pixels_) {
        pixels_->bind();
        draw(frame, pixels_->drawProgram());
      } else if (!soup_) {
        draw(frame, *program_);
      } else if (number == 0) {
        draw(frame, *captureProgram_, &*soup_);
      } else {
        soupProgram_->use();
        soupProgram_->set("anchorToClip", frame::anchorToClip(frame));
        soup_->drawTriangles();
      }
    };
    const int others = settings_.passes - 1;
    if (otherPasses_) otherPasses_->render(frame, others, pass);
    picture_->render(frame, [&] { pass(others); });
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const uint32_t triangles = picture_->countTriangles(frame, [&] { draw(frame, *program_); });
    double culled = 0.0, used = 0.0;
    for (const PatchFactors& of : factors_->factors().read<PatchFactors>(0, patches_->count()))
      culled += of.segments == 0;
    if (batches_) {
      for (const PatternCommand& command : batches_->commands().read<PatternCommand>())
        used += command.instances > 0;
    } else {
      std::set<uint32_t> patterns;
      for (const PatternCommand& command : commands_) patterns.insert(command.firstIndex);
      used = static_cast<double>(patterns.size());
    }
    const double calls = batches_ ? 1.0 : static_cast<double>(commands_.size() + coarseCommands_.size());
    const PatternSetSize set = setSize();
    const double soupTriangles = soup_ ? std::min(double(triangles), double(soupCapacity_)) : 0.0;
    return {{"patches_culled", culled},
            {"patches_capped", double(factors_->countCapped(frame))},
            {"patches_left_out", double(leftOut_)},
            {"tessellated_triangles", double(triangles)},
            {"draw_calls", calls},
            {"patterns_drawn", used},
            {"pattern_set", set.patterns},
            {"pattern_set_indices", set.indices},
            {"patterns_mib", double(meshes_->bytesUsed()) / 1048576.0},
            {"soup_mib", soupTriangles * 3.0 * sizeof(TessellatedVertex) / 1048576.0},
            {"soup_left_out", soup_ ? double(triangles) - soupTriangles : 0.0}};
  }

 private:
  struct PatternSetSize {
    double patterns = 0.0, indices = 0.0;
  };
  /// All that storing every pattern in advance would take (Schwarz 2009, Table 7.3); adapted ones are
  /// uniform.
  PatternSetSize setSize() const {
    const surfaces::Domain domain = domains_.empty() ? surfaces::Domain::Triangle : domains_[0];
    std::vector<int> steps;
    for (int m = 1; m <= settings_.most(); settings_.dyadic() ? m *= 2 : ++m) steps.push_back(m);
    const bool fourth = domain == surfaces::Domain::Rectangle;
    PatternSetSize out;
    const auto add = [&](const surfaces::Factors& factors) {
      out.patterns += 1.0;
      out.indices += surfaces::patternOf(domain, factors, settings_.tessellation.cornerFix).indices;
    };
    for (const int a : steps) {
      if (settings_.adapted()) {
        add({a, a, a, a});
        continue;
      }
      for (const int b : steps)
        for (const int c : steps) {
          if (fourth) {
            for (const int d : steps) add({a, b, c, d});
          } else {
            add({a, b, c, 0});
          }
        }
    }
    return out;
  }

  /// Waits for the factors.
  void buildBatches() {
    const std::vector<PatchFactors> factors = factors_->factors().read<PatchFactors>(0, patches_->count());
    std::map<std::pair<surfaces::Domain, surfaces::Factors>, std::vector<uint32_t>> byPattern;
    for (uint32_t i = 0; i < factors.size(); ++i) {
      if (factors[i].segments == 0) continue;
      surfaces::Factors own = factorsOf(factors[i].segments, domains_[i]);
      const int most = *std::max_element(own.begin(), own.end());
      if (settings_.adapted())
        for (uint32_t side = 0; side < static_cast<uint32_t>(surfaces::sidesOf(domains_[i])); ++side)
          own[side] = most;
      if (settings_.coarseFirst && most == 1) continue;
      byPattern[{domains_[i], own}].push_back(i);
    }
    commands_.clear(), points_.clear();
    leftOut_ = 0, evaluated_ = 0;
    std::vector<uint32_t> instances, places;
    for (auto& [key, patches] : byPattern) {
      const std::optional<PatternMeshes::Mesh> mesh = meshes_->meshOf(key.first, key.second);
      if (!mesh) {
        leftOut_ += patches.size();
        continue;
      }
      if (pixels_) {
        const auto room = static_cast<size_t>((pixels_->capacity() - evaluated_) / mesh->vertices);
        if (patches.size() > room) leftOut_ += patches.size() - room, patches.resize(room);
        points_.push_back({mesh->firstVertex, mesh->vertices, static_cast<uint32_t>(patches.size()),
                           static_cast<uint32_t>(instances.size())});
        for (size_t i = 0; i < patches.size(); ++i, evaluated_ += mesh->vertices)
          places.push_back(static_cast<uint32_t>(evaluated_) - mesh->firstVertex);  // may wrap around
      }
      PatternCommand command{mesh->indices, 1, mesh->firstIndex, mesh->firstVertex,
                             static_cast<uint32_t>(instances.size())};
      instances.insert(instances.end(), patches.begin(), patches.end());
      if (settings_.draw == PatternDraw::Instanced) {
        command.instances = static_cast<uint32_t>(patches.size());
        commands_.push_back(command);
      } else {
        for (size_t i = 0; i < patches.size(); ++i, ++command.firstInstance) commands_.push_back(command);
      }
    }
    if (!instances.empty())
      instances_->write(0, static_cast<int64_t>(instances.size()) * 4, instances.data());
    if (!places.empty()) places_->write(0, static_cast<int64_t>(places.size()) * 4, places.data());
  }

  /// Once for all passes of the frame.
  void evaluatePixels(frame::Frame& frame) const {
    patches_->bindStorage();
    factors_->factors().bindStorage(kFactorsBuffer);
    glBindVertexArray(vertexArray_);
    pixels_->run(frame, evaluated_, [&] {
      for (const PointsCommand& of : points_)
        glDrawArraysInstancedBaseInstance(GL_POINTS, static_cast<GLint>(of.firstVertex),
                                          static_cast<GLsizei>(of.vertices),
                                          static_cast<GLsizei>(of.instances), of.firstInstance);
    });
  }

  /// Patches of each domain with the pattern of one segment a side; they do not change.
  void prepareCoarse(frame::Frame& frame, gl::ShaderDefines defines) {
    defines["COARSE"] = "1";
    coarseProgram_ =
        &frame.context().programs().get({"renderer/techniques/tessellation/patterns/pattern.vert.glsl",
                                         "renderer/techniques/tessellation/surface.frag.glsl"},
                                        defines);
    std::vector<uint32_t> numbers;
    for (const surfaces::Domain domain : {surfaces::Domain::Rectangle, surfaces::Domain::Triangle}) {
      PatternCommand command{0, 0, 0, 0, static_cast<uint32_t>(numbers.size())};
      for (uint32_t i = 0; i < domains_.size(); ++i)
        if (domains_[i] == domain) numbers.push_back(i);
      command.instances = static_cast<uint32_t>(numbers.size()) - command.firstInstance;
      const std::optional<PatternMeshes::Mesh> mesh =
          meshes_->meshOf(domain, {1, 1, 1, domain == surfaces::Domain::Rectangle ? 1 : 0});
      if (command.instances == 0 || !mesh) continue;
      command.indices = mesh->indices;
      command.firstIndex = mesh->firstIndex;
      command.firstVertex = mesh->firstVertex;
      coarseCommands_.push_back(command);
    }
    coarseInstances_.emplace(numbers);
  }

  /// Waits for the GPU.
  int64_t trianglesOfFirstView(frame::Frame& frame) {
    factors_->run(frame);
    int64_t triangles = 0;
    const std::vector<PatchFactors> factors = factors_->factors().read<PatchFactors>(0, patches_->count());
    for (size_t i = 0; i < factors.size(); ++i) {
      if (factors[i].segments == 0) continue;
      surfaces::Factors own = factorsOf(factors[i].segments, domains_[i]);
      const int most = *std::max_element(own.begin(), own.end());
      triangles +=
          settings_.adapted() ? 2 * int64_t{most} * most : surfaces::patternOf(domains_[i], own).triangles;
    }
    return std::max<int64_t>(triangles, 1);
  }

  /// Room for twice the triangles of the first view.
  void prepareSoup(frame::Frame& frame, gl::ShaderDefines defines) {
    soupCapacity_ = 2 * trianglesOfFirstView(frame);
    soup_.emplace(3 * soupCapacity_);
    defines["CAPTURE"] = "1";
    captureProgram_ =
        &frame.context().programs().get({"renderer/techniques/tessellation/patterns/pattern.vert.glsl",
                                         "renderer/techniques/tessellation/surface.frag.glsl"},
                                        defines);
    soupProgram_ =
        &frame.context().programs().get({"renderer/techniques/tessellation/compute/surface.vert.glsl",
                                         "renderer/techniques/tessellation/surface.frag.glsl"});
    frame.passes().setBytesHeld("tessellation/soup", soup_->vertices().bytes());
  }

  void drawCoarse(frame::Frame& frame) const {
    coarseProgram_->use();
    coarseProgram_->set("anchorToClip", frame::anchorToClip(frame));
    glVertexArrayVertexBuffer(vertexArray_, 1, coarseInstances_->id(), 0, sizeof(uint32_t));
    issue(coarseCommands_);
    glVertexArrayVertexBuffer(vertexArray_, 1, instances_->id(), 0, sizeof(uint32_t));
  }

  static void issue(const std::vector<PatternCommand>& commands) {
    for (const PatternCommand& of : commands)
      glDrawElementsInstancedBaseVertexBaseInstance(
          GL_TRIANGLE_STRIP, static_cast<GLsizei>(of.indices), GL_UNSIGNED_INT,
          reinterpret_cast<const void*>(uintptr_t{of.firstIndex} * 4), static_cast<GLsizei>(of.instances),
          static_cast<GLint>(of.firstVertex), of.firstInstance);
  }

  /// `into`: stores the triangles as well.
  void draw(frame::Frame& frame, const gl::Program& program, const VertexFeedback* into = nullptr) const {
    patches_->bindStorage();
    factors_->factors().bindStorage(kFactorsBuffer);
    glEnable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
    glBindVertexArray(vertexArray_);
    if (settings_.coarseFirst) drawCoarse(frame);
    program.use();
    program.set("anchorToClip", frame::anchorToClip(frame));
    if (into) {
      into->capture(GL_TRIANGLES, [&] { issueAll(); });
    } else {
      issueAll();
    }
    glDisable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
  }

  void issueAll() const {
    if (batches_) {
      glBindBuffer(GL_DRAW_INDIRECT_BUFFER, batches_->commands().id());
      glMultiDrawElementsIndirect(GL_TRIANGLE_STRIP, GL_UNSIGNED_INT, nullptr, batches_->commandCount(),
                                  sizeof(PatternCommand));
      glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    } else {
      issue(commands_);
    }
  }

  void makeVertexArray(const gl::Buffer& instances) {
    glCreateVertexArrays(1, &vertexArray_);
    glVertexArrayAttribIFormat(vertexArray_, 0, 4, GL_INT, 0);
    glVertexArrayAttribIFormat(vertexArray_, 1, 1, GL_UNSIGNED_INT, 0);
    for (const GLuint location : {0U, 1U}) {
      glVertexArrayAttribBinding(vertexArray_, location, location);
      glEnableVertexArrayAttrib(vertexArray_, location);
    }
    glVertexArrayBindingDivisor(vertexArray_, 1, 1);
    glVertexArrayVertexBuffer(vertexArray_, 0, meshes_->samples().id(), 0, sizeof(glm::ivec4));
    glVertexArrayVertexBuffer(vertexArray_, 1, instances.id(), 0, sizeof(uint32_t));
    glVertexArrayElementBuffer(vertexArray_, meshes_->indices().id());
    if (!places_) return;
    constexpr GLuint kPlace = 2;
    glVertexArrayAttribIFormat(vertexArray_, kPlace, 1, GL_UNSIGNED_INT, 0);
    glVertexArrayAttribBinding(vertexArray_, kPlace, kPlace);
    glEnableVertexArrayAttrib(vertexArray_, kPlace);
    glVertexArrayBindingDivisor(vertexArray_, kPlace, 1);
    glVertexArrayVertexBuffer(vertexArray_, kPlace, places_->id(), 0, sizeof(uint32_t));
  }

  /// Vertices of a pattern for some patches.
  struct PointsCommand {
    uint32_t firstVertex = 0, vertices = 0, instances = 0, firstInstance = 0;
  };

  Settings settings_;
  std::optional<PatchBuffers> patches_;
  std::optional<FactorPass> factors_;
  std::optional<SurfacePicture> picture_;
  std::optional<PatternMeshes> meshes_;
  std::optional<PatternBatches> batches_;  // multi_draw
  std::optional<gl::Buffer> instances_;    // others
  std::vector<PatternCommand> commands_;
  std::vector<surfaces::Domain> domains_;
  const gl::Program *program_ = nullptr, *captureProgram_ = nullptr, *soupProgram_ = nullptr,
                    *coarseProgram_ = nullptr;
  std::optional<DepthPasses> otherPasses_;
  std::optional<VertexFeedback> soup_;
  int64_t soupCapacity_ = 0;  // triangles
  std::optional<gl::Buffer> coarseInstances_;
  std::vector<PatternCommand> coarseCommands_;
  std::optional<PixelEvaluation> pixels_;
  std::optional<gl::Buffer> places_;  // of each instance's first texel, less its pattern's first vertex
  std::vector<PointsCommand> points_;
  int64_t evaluated_ = 0;  // vertices
  size_t leftOut_ = 0;
  uint32_t vertexArray_ = 0;
};

const RegisteredTechnique<RefinementPatterns> kRefinementPatternsRegistered{
    {.name = "tessellation/patterns",
     .version = 1,
     .summary = "Curved surfaces by stored tessellation patterns that the vertex shader puts on patches",
     .source = "Schwarz 2009, section 7.5 (SC-60)",
     .product = ProductKind::Colour,
     .needs = {"curved_surfaces"},
     .counters = {
         {"patches_culled", "Patches culled", "patches", Direction::Neither},
         {"patches_capped", "Patches that more segments than allowed would be needed for", "patches",
          Direction::LowerIsBetter},
         {"patches_left_out", "Patches left out for want of capacity", "patches", Direction::LowerIsBetter},
         {"tessellated_triangles", "Triangles made", "triangles", Direction::LowerIsBetter},
         {"draw_calls", "Draw calls", "", Direction::LowerIsBetter},
         {"patterns_drawn", "Patterns drawn", "", Direction::LowerIsBetter},
         {"pattern_set", "Patterns that there are up to the largest factor, of the first patch's domain", "",
          Direction::LowerIsBetter},
         {"pattern_set_indices", "Indices of all of these", "indices", Direction::LowerIsBetter},
         {"patterns_mib", "Patterns stored", "MiB", Direction::LowerIsBetter},
         {"soup_mib", "Triangles stored for later passes", "MiB", Direction::LowerIsBetter},
         {"soup_left_out", "Triangles left out of later passes for want of capacity", "triangles",
          Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
