// SPDX-License-Identifier: BSD-3-Clause
// Dyadic connection patterns (SC-61, SC-62): each patch is drawn with a uniform pattern of its own power of
// two, whatever its neighbours have, and strips along common sides close what this leaves open. Strips that
// would fold over are left to back-face culling, so that the surface must be closed. Normals along a strip
// are those of the coarser patch. The host reads the factors, which the thesis computes there.
#include <epoxy/gl.h>

#include <bit>

#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/factor_pass.h"
#include "renderer/techniques/tessellation/patterns/connection_patterns.h"
#include "renderer/techniques/tessellation/surface_picture.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {
namespace {

struct ConnectedSettings {
  FactorSettings tessellation;
  bool batched = true, strips = true;
  frame::ShadedSetting shading;
  static const SettingsTable<ConnectedSettings>& table() {
    using S = ConnectedSettings;
    static const SettingsTable<S> kTable = {
        included(&S::tessellation),
        {&S::batched, "batched", "Draw all patches of a level, and all strips of two levels, at once",
         "Schwarz 2009, section 7.5.3"},
        {&S::strips, "strips", "Draw the strips; without, the surface has gaps",
         "Schwarz 2009, section 7.5.2"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class ConnectedPatterns : public Technique {
 public:
  using Settings = ConnectedSettings;
  explicit ConnectedPatterns(const Settings& settings) : settings_(settings) {}
  ~ConnectedPatterns() override {
    if (vertexArray_) glDeleteVertexArrays(1, &vertexArray_);
  }

  void prepare(frame::Frame& frame) override {
    const std::string folder = "renderer/techniques/tessellation/";
    surfaces_ = &frame.scene().surfaces;
    for (const surfaces::Patch& patch : surfaces_->patches)
      if (patch.domain != surfaces_->patches[0].domain)
        throw Error("connection patterns are for scenes of one kind of patch", "technique",
                    "use tessellation/patterns");
    patches_.emplace(frame.scene(), frame.gpuScene().anchor());
    factors_.emplace(frame, *patches_, settings_.tessellation, false, Spacing::Dyadic);
    picture_.emplace(frame, settings_.shading, "tessellation");
    const auto* deviation = std::get_if<ByDeviation>(&settings_.tessellation.factors);
    const int most =
        deviation ? deviation->most : std::get<BySegments>(settings_.tessellation.factors).segments;
    patterns_.emplace(surfaces_->patches[0].domain,
                      static_cast<int>(std::bit_ceil(static_cast<unsigned>(most))));
    samples_.emplace(patterns_->samples());
    indices_.emplace(patterns_->indices());
    // Each patch, and at most one strip for each of its sides.
    instances_.emplace(int64_t{patches_->count()} * 5 * 4, nullptr);
    gl::ShaderDefines defines = patches_->defines();
    const auto program = [&] {
      return &frame.context().programs().get(
          {folder + "patterns/pattern.vert.glsl", folder + "surface.frag.glsl"}, defines);
    };
    program_ = program();
    defines["CONNECTING"] = "1";
    stripProgram_ = program();
    makeVertexArray();
    frame.passes().setBytesHeld("tessellation/factors", patches_->bytes() + factors_->bytes());
    frame.passes().setBytesHeld("tessellation/batches", instances_->bytes());
    frame.passes().setBytesHeld("tessellation/patterns", samples_->bytes() + indices_->bytes());
  }

  void render(frame::Frame& frame) override {
    factors_->run(frame);
    {
      const auto scope = frame.passes().open("tessellation/batches");
      build();
    }
    picture_->render(frame, [&] { draw(frame); });
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::vector<Counter> count(frame::Frame&) override {
    double triangles = 0.0, strips = 0.0, sides = 0.0, culled = 0.0;
    for (const int level : levels_) {
      culled += level == 0;
      triangles +=
          double(level) * level * (surfaces_->patches[0].domain == surfaces::Domain::Rectangle ? 2 : 1);
    }
    for (const PatternCommand& command : stripCommands_) {
      strips += command.instances * (command.indices / 4);
      sides += command.instances;
    }
    return {{"patches_culled", culled},
            {"tessellated_triangles", triangles + strips},
            {"strip_triangles", strips},
            {"sides_stitched", sides},
            {"draw_calls", double(levelCommands_.size() + stripCommands_.size())}};
  }

 private:
  /// Waits for the factors.
  void build() {
    const std::vector<glm::uvec2> own = factors_->ownFactors().read<glm::uvec2>(0, patches_->count());
    const auto count = static_cast<size_t>(patches_->count());
    std::map<int, std::vector<uint32_t>> byLevel;
    std::map<std::pair<int, int>, std::vector<uint32_t>> byPair;
    levels_.assign(count, 0);
    for (size_t i = 0; i < count; ++i) {
      const uint32_t most = std::max({own[i].x & 65535U, own[i].x >> 16, own[i].y & 65535U, own[i].y >> 16});
      if (most == 0) continue;
      levels_[i] = surfaces::spacedSegments(surfaces::kSpacingDyadic, static_cast<int>(most));
      byLevel[levels_[i]].push_back(static_cast<uint32_t>(i));
    }
    if (settings_.strips)
      for (size_t i = 0; i < count && i < surfaces_->neighbours.size(); ++i)
        for (size_t side = 0; side < static_cast<size_t>(surfaces::sidesOf(surfaces_->patches[i].domain));
             ++side) {
          const int32_t other = surfaces_->neighbours[i][side].patch;
          if (other < 0 || levels_[i] == 0 || levels_[static_cast<size_t>(other)] <= levels_[i]) continue;
          byPair[{levels_[i], levels_[static_cast<size_t>(other)]}].push_back(
              static_cast<uint32_t>(4 * i + side));
        }
    std::vector<uint32_t> instances;
    levelCommands_.clear();
    stripCommands_.clear();
    for (const auto& [level, numbers] : byLevel)
      add(patterns_->levelOf(level), numbers, instances, levelCommands_);
    for (const auto& [pair, numbers] : byPair)
      add(patterns_->stripOf(pair.first, pair.second), numbers, instances, stripCommands_);
    if (!instances.empty())
      instances_->write(0, static_cast<int64_t>(instances.size()) * 4, instances.data());
  }

  void add(const PatternMeshes::Mesh& mesh, const std::vector<uint32_t>& numbers,
           std::vector<uint32_t>& instances, std::vector<PatternCommand>& commands) const {
    PatternCommand command{mesh.indices, settings_.batched ? static_cast<uint32_t>(numbers.size()) : 1U,
                           mesh.firstIndex, mesh.firstVertex, static_cast<uint32_t>(instances.size())};
    for (size_t i = 0; i < (settings_.batched ? 1 : numbers.size()); ++i, ++command.firstInstance)
      commands.push_back(command);
    instances.insert(instances.end(), numbers.begin(), numbers.end());
  }

  void draw(frame::Frame& frame) const {
    patches_->bindStorage();
    factors_->factors().bindStorage(kFactorsBuffer);
    glEnable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
    glBindVertexArray(vertexArray_);
    const auto issue = [&](const gl::Program& program, const std::vector<PatternCommand>& commands) {
      program.use();
      program.set("anchorToClip", frame::anchorToClip(frame));
      for (const PatternCommand& of : commands)
        glDrawElementsInstancedBaseVertexBaseInstance(
            GL_TRIANGLE_STRIP, static_cast<GLsizei>(of.indices), GL_UNSIGNED_INT,
            reinterpret_cast<const void*>(uintptr_t{of.firstIndex} * 4), static_cast<GLsizei>(of.instances),
            static_cast<GLint>(of.firstVertex), of.firstInstance);
    };
    issue(*program_, levelCommands_);
    glEnable(GL_CULL_FACE);
    issue(*stripProgram_, stripCommands_);
    glDisable(GL_CULL_FACE);
    glDisable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
  }

  void makeVertexArray() {
    glCreateVertexArrays(1, &vertexArray_);
    glVertexArrayAttribIFormat(vertexArray_, 0, 4, GL_INT, 0);
    glVertexArrayAttribIFormat(vertexArray_, 1, 1, GL_UNSIGNED_INT, 0);
    for (const GLuint location : {0U, 1U}) {
      glVertexArrayAttribBinding(vertexArray_, location, location);
      glEnableVertexArrayAttrib(vertexArray_, location);
    }
    glVertexArrayBindingDivisor(vertexArray_, 1, 1);
    glVertexArrayVertexBuffer(vertexArray_, 0, samples_->id(), 0, sizeof(glm::ivec4));
    glVertexArrayVertexBuffer(vertexArray_, 1, instances_->id(), 0, sizeof(uint32_t));
    glVertexArrayElementBuffer(vertexArray_, indices_->id());
  }

  Settings settings_;
  const surfaces::PatchSet* surfaces_ = nullptr;
  std::optional<PatchBuffers> patches_;
  std::optional<FactorPass> factors_;
  std::optional<SurfacePicture> picture_;
  std::optional<ConnectionPatterns> patterns_;
  std::optional<gl::Buffer> samples_, indices_, instances_;
  std::vector<int> levels_;  // of each patch; 0: culled
  std::vector<PatternCommand> levelCommands_, stripCommands_;
  const gl::Program *program_ = nullptr, *stripProgram_ = nullptr;
  uint32_t vertexArray_ = 0;
};

const RegisteredTechnique<ConnectedPatterns> kConnectedPatternsRegistered{
    {.name = "tessellation/connected_patterns",
     .version = 1,
     .summary = "Curved surfaces by uniform patterns of powers of two, with strips between patches of "
                "different levels",
     .source = "Schwarz 2009, section 7.5.2 (SC-62)",
     .product = ProductKind::Colour,
     .needs = {"curved_surfaces"},
     .counters = {{"patches_culled", "Patches culled", "patches", Direction::Neither},
                  {"tessellated_triangles", "Triangles made", "triangles", Direction::LowerIsBetter},
                  {"strip_triangles", "Triangles of strips", "triangles", Direction::LowerIsBetter},
                  {"sides_stitched", "Sides with strips", "sides", Direction::Neither},
                  {"draw_calls", "Draw calls", "", Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
