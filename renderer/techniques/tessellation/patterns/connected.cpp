// SPDX-License-Identifier: BSD-3-Clause
// Dyadic connection patterns (SC-61, SC-62): each patch is drawn with a uniform pattern of its own power of
// two, whatever its neighbours have, and strips along common sides close what this leaves open. Strips that
// would fold over are left to back-face culling, so that the surface must be closed. Normals along a strip
// are those of the coarser patch. Where neighbours have different curves between the same ends, as PN
// triangles at creases, a strip joins the two curves whatever their levels, with the normals of one of them
// (SC-63). The host reads the factors, which the thesis computes there.
#include <epoxy/gl.h>

#include <bit>

#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/surfaces/inherent_gaps.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/factor_pass.h"
#include "renderer/techniques/tessellation/patterns/connection_patterns.h"
#include "renderer/techniques/tessellation/patterns/crossings.h"
#include "renderer/techniques/tessellation/surface_picture.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {
namespace {

struct ConnectedSettings {
  FactorSettings tessellation;
  bool batched = true, strips = true, closeGaps = true;
  double borderPx = 0.0;
  frame::ShadedSetting shading;
  static const SettingsTable<ConnectedSettings>& table() {
    using S = ConnectedSettings;
    static const SettingsTable<S> kTable = {
        included(&S::tessellation),
        {&S::batched, "batched", "Draw all patches of a level, and all strips of two levels, at once",
         "Schwarz 2009, section 7.5.3"},
        {&S::strips, "strips", "Draw the strips; without, the surface has gaps",
         "Schwarz 2009, section 7.5.2"},
        {&S::closeGaps, "close_gaps",
         "Draw strips as well where neighbours with different normals have different boundaries",
         "Schwarz 2009, section 7.5.2"},
        {&S::borderPx,
         "border_px",
         {0.0, 8.0},
         "px",
         "Bands along all sides of patches, this wide to either hand on the screen, which hide gaps instead "
         "of closing "
         "them; usually with strips: false. 0: none",
         "Guthe, Balázs and Klein 2005; Schwarz 2009, section 7.5.1"},
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
    surfaces_ = &frame.scene().surfaces;
    for (const surfaces::Patch& patch : surfaces_->patches)
      if (patch.domain != surfaces_->patches[0].domain)
        throw Error("connection patterns are for scenes of one kind of patch", "technique",
                    "use tessellation/patterns");
    patches_.emplace(frame.scene(), frame.gpuScene().anchor());
    factors_.emplace(frame, *patches_, settings_.tessellation, false, Spacing::Dyadic);
    picture_.emplace(frame, settings_.shading, "tessellation");
    const int most = settings_.tessellation.mostSegments();
    patterns_.emplace(surfaces_->patches[0].domain,
                      static_cast<int>(std::bit_ceil(static_cast<unsigned>(most))));
    samples_.emplace(patterns_->samples());
    indices_.emplace(patterns_->indices());
    // Each patch, and for each of its sides at most one strip and one border.
    instances_.emplace(int64_t{patches_->count()} * 9 * 4, nullptr);
    if (settings_.strips && settings_.closeGaps) gaps_ = surfaces::inherentGaps(*surfaces_);
    if (!gaps_.empty()) gapStrips_.emplace(static_cast<int64_t>(gaps_.size() * sizeof(glm::uvec2)), nullptr);
    programs_ = programsWith(frame, "renderer/techniques/tessellation/surface.frag.glsl");
    makeVertexArray();
    frame.passes().setBytesHeld("tessellation/factors", patches_->bytes() + factors_->bytes());
    frame.passes().setBytesHeld("tessellation/batches",
                                instances_->bytes() + (gapStrips_ ? gapStrips_->bytes() : 0));
    frame.passes().setBytesHeld("tessellation/patterns", samples_->bytes() + indices_->bytes());
  }

  void render(frame::Frame& frame) override {
    factors_->run(frame);
    {
      const auto scope = frame.passes().open("tessellation/batches");
      build();
    }
    picture_->render(frame, [&] { draw(frame, programs_, true); });
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const Programs crossings =
        programsWith(frame, "renderer/techniques/tessellation/patterns/crossings.frag.glsl");
    const uint32_t cracks = unevenCrossings(frame.sizePx(), [&] { draw(frame, crossings, false); });
    double triangles = 0.0, strips = 0.0, sides = 0.0, closed = 0.0, culled = 0.0;
    for (const int level : levels_) {
      culled += level == 0;
      triangles +=
          double(level) * level * (surfaces_->patches[0].domain == surfaces::Domain::Rectangle ? 2 : 1);
    }
    for (const PatternCommand& command : stripCommands_) {
      strips += command.instances * (command.indices / 4);
      sides += command.instances;
    }
    for (const PatternCommand& command : gapCommands_) {
      strips += command.instances * (command.indices / 4);
      closed += command.instances;
    }
    double borders = 0.0;
    for (const PatternCommand& command : borderCommands_)
      borders += command.instances * (command.indices - 2);
    return {{"patches_culled", culled},
            {"tessellated_triangles", triangles + strips + borders},
            {"border_triangles", borders},
            {"strip_triangles", strips},
            {"sides_stitched", sides},
            {"gaps_closed", closed},
            {"crack_pixels", double(cracks)},
            {"draw_calls", double(levelCommands_.size() + stripCommands_.size() + gapCommands_.size() +
                                  borderCommands_.size())}};
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
    const auto gapsByPair = gapStripsByLevels();
    std::vector<uint32_t> instances;
    levelCommands_.clear();
    stripCommands_.clear();
    gapCommands_.clear();
    borderCommands_.clear();
    for (const auto& [level, numbers] : byLevel)
      add(patterns_->levelOf(level), numbers, instances, levelCommands_);
    if (settings_.borderPx > 0.0)
      for (const auto& [level, numbers] : byLevel) {
        std::vector<uint32_t> sides;
        for (const uint32_t number : numbers)
          for (int side = 0; side < surfaces::sidesOf(surfaces_->patches[0].domain); ++side)
            sides.push_back(4 * number + static_cast<uint32_t>(side));
        add(patterns_->borderOf(level), sides, instances, borderCommands_);
      }
    for (const auto& [pair, numbers] : byPair)
      add(patterns_->stripOf(pair.first, pair.second), numbers, instances, stripCommands_);
    std::vector<glm::uvec2> gapStrips;
    for (const auto& [pair, strips] : gapsByPair) {
      std::vector<uint32_t> numbers;
      for (const glm::uvec2& strip : strips) {
        numbers.push_back(static_cast<uint32_t>(gapStrips.size()));
        gapStrips.push_back(strip);
      }
      add(patterns_->stripOf(pair.first, pair.second), numbers, instances, gapCommands_);
    }
    if (!gapStrips.empty())
      gapStrips_->write(0, static_cast<int64_t>(gapStrips.size() * sizeof(glm::uvec2)), gapStrips.data());
    if (!instances.empty())
      instances_->write(0, static_cast<int64_t>(instances.size()) * 4, instances.data());
  }

  /// For each pair of levels, the coarser first, what the shader reads of a strip (GAPS). Next to a culled
  /// patch the level is that of the other.
  std::map<std::pair<int, int>, std::vector<glm::uvec2>> gapStripsByLevels() const {
    std::map<std::pair<int, int>, std::vector<glm::uvec2>> out;
    for (const surfaces::InherentGap& gap : gaps_) {
      std::array<int, 2> levels = {levels_[gap.patches[0]], levels_[gap.patches[1]]};
      const int finest = std::max(levels[0], levels[1]);
      if (finest == 0) continue;
      for (int& level : levels)
        if (level == 0) level = finest;
      const size_t coarse = levels[1] < levels[0] ? 1 : 0;
      const auto sideOf = [&](size_t i) { return 4 * gap.patches[i] + static_cast<uint32_t>(gap.sides[i]); };
      const bool own = static_cast<size_t>(gap.normalsFrom) == coarse;
      out[{levels[coarse], finest}].emplace_back(sideOf(coarse) | (own ? kGapNormalsOfOwn : 0U),
                                                 sideOf(1 - coarse));
    }
    return out;
  }

  void add(const PatternMeshes::Mesh& mesh, const std::vector<uint32_t>& numbers,
           std::vector<uint32_t>& instances, std::vector<PatternCommand>& commands) const {
    PatternCommand command{mesh.indices, settings_.batched ? static_cast<uint32_t>(numbers.size()) : 1U,
                           mesh.firstIndex, mesh.firstVertex, static_cast<uint32_t>(instances.size())};
    for (size_t i = 0; i < (settings_.batched ? 1 : numbers.size()); ++i, ++command.firstInstance)
      commands.push_back(command);
    instances.insert(instances.end(), numbers.begin(), numbers.end());
  }

  struct Programs {
    const gl::Program *levels = nullptr, *strips = nullptr, *gaps = nullptr, *borders = nullptr;
  };
  Programs programsWith(frame::Frame& frame, const std::string& fragmentShader) const {
    gl::ShaderDefines defines = patches_->defines();
    const auto program = [&] {
      return &frame.context().programs().get(
          {"renderer/techniques/tessellation/patterns/pattern.vert.glsl", fragmentShader}, defines);
    };
    Programs out;
    out.levels = program();
    defines["CONNECTING"] = "1";
    out.strips = program();
    if (settings_.borderPx > 0.0) {
      defines["BORDER"] = "1";
      out.borders = program();
      defines.erase("BORDER");
    }
    if (gaps_.empty()) return out;
    defines.erase("CONNECTING");
    defines["GAPS"] = "1";
    out.gaps = program();
    return out;
  }

  /// `shown`: with borders, and without strips that have folded over.
  void draw(frame::Frame& frame, const Programs& programs, bool shown) const {
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
    issue(*programs.levels, levelCommands_);
    if (shown && programs.borders) {
      programs.borders->set("sizePx", glm::vec2(frame.sizePx()));
      programs.borders->set("borderPx", static_cast<float>(settings_.borderPx));
      issue(*programs.borders, borderCommands_);
    }
    if (shown) glEnable(GL_CULL_FACE);
    issue(*programs.strips, stripCommands_);
    if (programs.gaps) {
      gapStrips_->bindStorage(kGapStripsBuffer);
      issue(*programs.gaps, gapCommands_);
    }
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
  std::vector<surfaces::InherentGap> gaps_;
  std::optional<gl::Buffer> samples_, indices_, instances_, gapStrips_;
  std::vector<int> levels_;  // of each patch; 0: culled
  std::vector<PatternCommand> levelCommands_, stripCommands_, gapCommands_, borderCommands_;
  Programs programs_;
  uint32_t vertexArray_ = 0;
};

const RegisteredTechnique<ConnectedPatterns> kConnectedPatternsRegistered{
    {.name = "tessellation/connected_patterns",
     .version = 2,
     .summary = "Curved surfaces by uniform patterns of powers of two, with strips between patches of "
                "different levels",
     .source = "Schwarz 2009, section 7.5.2 (SC-62, SC-63)",
     .product = ProductKind::Colour,
     .needs = {"curved_surfaces"},
     .counters = {{"patches_culled", "Patches culled", "patches", Direction::Neither},
                  {"tessellated_triangles", "Triangles made", "triangles", Direction::LowerIsBetter},
                  {"strip_triangles", "Triangles of strips", "triangles", Direction::LowerIsBetter},
                  {"border_triangles", "Triangles of borders", "triangles", Direction::LowerIsBetter},
                  {"sides_stitched", "Sides with strips", "sides", Direction::Neither},
                  {"gaps_closed", "Gaps at creases closed", "gaps", Direction::Neither},
                  {"crack_pixels", "Pixels with a crack in closed surfaces, whatever borders hide", "px",
                   Direction::LowerIsBetter},
                  {"draw_calls", "Draw calls", "", Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
