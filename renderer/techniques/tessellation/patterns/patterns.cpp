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
#include "renderer/techniques/tessellation/patterns/pattern_batches.h"
#include "renderer/techniques/tessellation/surface_picture.h"

namespace limen::techniques {
namespace {

/// Who issues what.
enum class PatternDraw { Immediate, Instanced, MultiDraw };
constexpr EnumNames<PatternDraw, 3> enumNames(PatternDraw) {
  return {{{{PatternDraw::Immediate, "immediate"},
            {PatternDraw::Instanced, "instanced"},
            {PatternDraw::MultiDraw, "multi_draw"}}}};
}

/// Which patterns there are.
enum class PatternKind { Integer, Dyadic, Adapted, AdaptedInteger };
constexpr EnumNames<PatternKind, 4> enumNames(PatternKind) {
  return {{{{PatternKind::Adapted, "adapted"},
            {PatternKind::AdaptedInteger, "adapted_integer"},
            {PatternKind::Dyadic, "dyadic"},
            {PatternKind::Integer, "integer"}}}};
}

struct PatternSettings {
  FactorSettings tessellation;
  PatternKind patterns = PatternKind::Dyadic;
  PatternDraw draw = PatternDraw::Instanced;
  int64_t capacity = 1 << 20;
  frame::ShadedSetting shading;
  static const SettingsTable<PatternSettings>& table() {
    using S = PatternSettings;
    static const SettingsTable<S> kTable = {
        included(&S::tessellation),
        {&S::patterns, "patterns",
         "One for each tuple of factors, of whole numbers or powers of two; or uniform ones of the largest "
         "factor, with "
         "samples on sides moved to the side's own",
         "Schwarz 2009, sections 7.5.1 and 7.5.4"},
        {&S::draw, "draw", "A call for each patch, for each pattern, or one for all",
         "Schwarz 2009, section 7.5.3"},
        {&S::capacity,
         "capacity",
         {4, 1 << 26},
         "vertices",
         "Vertices of all patterns that the buffers hold; indices: six times as many"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
  bool adapted() const { return patterns == PatternKind::Adapted || patterns == PatternKind::AdaptedInteger; }
  bool dyadic() const { return patterns == PatternKind::Adapted || patterns == PatternKind::Dyadic; }
  int most() const {
    const auto* deviation = std::get_if<ByDeviation>(&tessellation.factors);
    return deviation ? deviation->most : std::get<BySegments>(tessellation.factors).segments;
  }
  void check() const {
    if (draw == PatternDraw::MultiDraw && !dyadic())
      throw Error("a single draw needs patterns that are known before", "draw",
                  "use patterns: dyadic or adapted, or draw: instanced");
  }
};

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
    picture_->render(frame, [&] { draw(frame); });
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const uint32_t triangles = picture_->countTriangles(frame, [&] { draw(frame); });
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
    const double calls = batches_ ? 1.0 : static_cast<double>(commands_.size());
    return {{"patches_culled", culled},
            {"patches_capped", double(factors_->countCapped(frame))},
            {"patches_left_out", double(leftOut_)},
            {"tessellated_triangles", double(triangles)},
            {"draw_calls", calls},
            {"patterns_drawn", used},
            {"patterns_mib", double(meshes_->bytesUsed()) / 1048576.0}};
  }

 private:
  /// Waits for the factors.
  void buildBatches() {
    const std::vector<PatchFactors> factors = factors_->factors().read<PatchFactors>(0, patches_->count());
    std::map<std::pair<surfaces::Domain, surfaces::Factors>, std::vector<uint32_t>> byPattern;
    for (uint32_t i = 0; i < factors.size(); ++i) {
      if (factors[i].segments == 0) continue;
      surfaces::Factors own{};
      int most = 1;
      for (uint32_t side = 0; side < static_cast<uint32_t>(surfaces::sidesOf(domains_[i])); ++side) {
        own[side] = static_cast<int>(factors[i].segments >> 8 * side & 255U);
        most = std::max(most, own[side]);
      }
      if (settings_.adapted())
        for (uint32_t side = 0; side < static_cast<uint32_t>(surfaces::sidesOf(domains_[i])); ++side)
          own[side] = most;
      byPattern[{domains_[i], own}].push_back(i);
    }
    commands_.clear();
    leftOut_ = 0;
    std::vector<uint32_t> instances;
    for (const auto& [key, patches] : byPattern) {
      const std::optional<PatternMeshes::Mesh> mesh = meshes_->meshOf(key.first, key.second);
      if (!mesh) {
        leftOut_ += patches.size();
        continue;
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
  }

  void draw(frame::Frame& frame) const {
    patches_->bindStorage();
    factors_->factors().bindStorage(kFactorsBuffer);
    program_->use();
    program_->set("anchorToClip", frame::anchorToClip(frame));
    glEnable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
    glBindVertexArray(vertexArray_);
    if (batches_) {
      glBindBuffer(GL_DRAW_INDIRECT_BUFFER, batches_->commands().id());
      glMultiDrawElementsIndirect(GL_TRIANGLE_STRIP, GL_UNSIGNED_INT, nullptr, batches_->commandCount(),
                                  sizeof(PatternCommand));
      glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    } else {
      for (const PatternCommand& of : commands_)
        glDrawElementsInstancedBaseVertexBaseInstance(
            GL_TRIANGLE_STRIP, static_cast<GLsizei>(of.indices), GL_UNSIGNED_INT,
            reinterpret_cast<const void*>(uintptr_t{of.firstIndex} * 4), static_cast<GLsizei>(of.instances),
            static_cast<GLint>(of.firstVertex), of.firstInstance);
    }
    glDisable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
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
  }

  Settings settings_;
  std::optional<PatchBuffers> patches_;
  std::optional<FactorPass> factors_;
  std::optional<SurfacePicture> picture_;
  std::optional<PatternMeshes> meshes_;
  std::optional<PatternBatches> batches_;  // multi_draw
  std::optional<gl::Buffer> instances_;    // others
  std::vector<PatternCommand> commands_;
  std::vector<surfaces::Domain> domains_;
  const gl::Program* program_ = nullptr;
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
         {"patterns_mib", "Patterns stored", "MiB", Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
