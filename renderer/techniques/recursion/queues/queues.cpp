// SPDX-License-Identifier: BSD-3-Clause
// Recursive refinement in compute queues (SC-38, SC-44): split and dice in the manner of Reyes as by Patney
// and Owens 2008 (Schwarz 2009, section 7.2.5). Two queues take turns; a round culls, finishes or splits each
// part of one into the other, and the host reads nothing back. Differences:
// - Finished parts leave the queue at once, as the thesis advises; they are not looked at again.
// - A part is a piece of the domain: its control points come from the patch in each round, so that errors do
// not add up.
// - Parts that are nearly flat are diced as well, by default into 4 x 4 cells, with a tolerance for the
// cells: at
//   equal error that takes a fraction of the parts tested.
// - Where a queue is full, parts are drawn as they are, and counted.
// - Nothing is done about cracks, as there; `recursion/cpu` with `split: restricted` closes them.
// Parts come in no particular order, so that buffers differ from run to run; the picture does not.
#include <epoxy/gl.h>

#include <algorithm>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/recursion/recursion_bindings.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/patch_buffers.h"
#include "renderer/techniques/tessellation/surface_picture.h"
#include "renderer/techniques/tessellation/surface_vertex_array.h"
#include "renderer/techniques/tessellation/surface_view.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {
namespace {

enum class QueueFlatness { ControlToChord, ControlToCorresponding, Extent };
constexpr EnumNames<QueueFlatness, 3> enumNames(QueueFlatness) {
  return {{{{QueueFlatness::ControlToChord, "control_to_chord"},
            {QueueFlatness::ControlToCorresponding, "control_to_corresponding"},
            {QueueFlatness::Extent, "extent"}}}};
}
enum class QueueSplit { Halves, Quarters };
constexpr EnumNames<QueueSplit, 2> enumNames(QueueSplit) {
  return {{{{QueueSplit::Halves, "halves"}, {QueueSplit::Quarters, "quarters"}}}};
}

struct QueueSettings {
  double tolerancePx = 0.25;
  QueueFlatness flatness = QueueFlatness::ControlToChord;
  QueueSplit split = QueueSplit::Quarters;
  int grid = 4;
  int mostSteps = 14;
  bool cull = true;
  int64_t capacity = 1 << 21;
  frame::ShadedSetting shading;
  static const SettingsTable<QueueSettings>& table() {
    using S = QueueSettings;
    static const SettingsTable<S> kTable = {
        {&S::tolerancePx,
         "tolerance_px",
         {0.05, 100},
         "px",
         "Flatness of a finished part's cells, or extent of the part",
         "Schwarz 2009 (flatness 0.5; extent 8)"},
        {&S::flatness, "flatness", "What of a part is measured", "Schwarz 2009, section 7.2.1"},
        {&S::split, "split", "How a rectangle is split; triangles always into four",
         "Schwarz 2009, section 7.2.2"},
        {&S::grid, "grid", oneOf({1, 2, 4, 8, 16}), "segments", "Segments of a finished part's sides",
         "Schwarz 2009, section 7.2.5 (split and dice: 16)"},
        {&S::mostSteps, "most_steps", {0, 20}, "steps", "Splits from a patch to a part at most"},
        {&S::cull, "cull", "Leave out parts outside the view"},
        {&S::capacity,
         "capacity",
         {1024, 1 << 26},
         "vertices",
         "Vertices that the buffers hold; queues hold as many parts as these make"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class QueueRecursion : public Technique {
 public:
  using Settings = QueueSettings;
  explicit QueueRecursion(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    refuseOtherDegrees(frame.scene().surfaces);
    const std::string folder = "renderer/techniques/recursion/queues/";
    gl::ProgramCache& programs = frame.context().programs();
    patches_.emplace(frame.scene(), frame.gpuScene().anchor());
    picture_.emplace(frame, settings_.shading, "recursion");
    gl::ShaderDefines defines = patches_->defines();
    diceProgram_ = &programs.compute(folder + "dice.comp.glsl", defines);
    defineEnum(defines, "FLATNESS", settings_.flatness);
    if (settings_.split == QueueSplit::Halves) defines["HALVES"] = "1";
    splitProgram_ = &programs.compute(folder + "split.comp.glsl", defines);
    roundsProgram_ = &programs.compute(folder + "rounds.comp.glsl");
    drawProgram_ = &programs.get({"renderer/techniques/tessellation/compute/surface.vert.glsl",
                                  "renderer/techniques/tessellation/surface.frag.glsl"});
    const int64_t vertices = int64_t{settings_.grid + 1} * (settings_.grid + 1),
                  indices = 6 * int64_t{settings_.grid} * settings_.grid;
    capacity_ = static_cast<uint32_t>(std::max<int64_t>(settings_.capacity / vertices, patches_->count()));
    first_.emplace(wholePatches(frame.scene().surfaces));
    for (auto& queue : queues_) queue.emplace(capacity_ * int64_t{sizeof(RecursionPart)}, nullptr);
    finished_.emplace(capacity_ * int64_t{sizeof(RecursionPart)}, nullptr);
    counters_.emplace(int64_t{sizeof(RecursionCounters)}, nullptr);
    vertices_.emplace(capacity_ * vertices * int64_t{sizeof(TessellatedVertex)}, nullptr);
    indices_.emplace(capacity_ * indices * 4, nullptr);
    array_.emplace(*vertices_, *indices_);
    frame.passes().setBytesHeld("recursion/split",
                                patches_->bytes() + first_->bytes() + 3 * finished_->bytes());
    frame.passes().setBytesHeld("recursion/dice", vertices_->bytes() + indices_->bytes());
  }

  void render(frame::Frame& frame) override {
    split(frame);
    dice(frame);
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT |
                    GL_COMMAND_BARRIER_BIT);
    picture_->render(frame, [&] {
      drawProgram_->use();
      drawProgram_->set("anchorToClip", frame::anchorToClip(frame));
      array_->bind();
      glBindBuffer(GL_DRAW_INDIRECT_BUFFER, counters_->id());
      glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                             reinterpret_cast<const void*>(offsetof(RecursionCounters, indices)));
      glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    });
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::shared_ptr<const surfaces::TessellatedSurface> tessellation(frame::Frame& frame) override {
    const uint32_t count = std::min(counters_->read<RecursionCounters>()[0].finished, capacity_);
    const auto parts = finished_->read<RecursionPart>(0, count);
    const auto grid = static_cast<uint32_t>(settings_.grid), side = grid + 1;
    const auto vertices = vertices_->read<TessellatedVertex>(0, int64_t{count} * side * side);
    auto out = std::make_shared<surfaces::TessellatedSurface>();
    const surfaces::PatchSet& set = frame.scene().surfaces;
    out->anchor = frame.gpuScene().anchor(), out->view = viewOf(frame);
    out->factors.assign(set.patches.size(), {});
    std::vector<uint32_t> places(vertices.size());
    for (uint32_t p = 0; p < count; ++p) {
      const RecursionPart& part = parts[p];
      const bool triangle = set.patches[part.patchNumber].domain == surfaces::Domain::Triangle;
      out->factors[part.patchNumber].fill(1);  // drawn
      for (uint32_t j = 0; j < side; ++j)
        for (uint32_t i = 0; i < side; ++i) {
          if (triangle && i + j > grid) continue;
          const uint32_t slot = (p * side + j) * side + i;
          places[slot] = static_cast<uint32_t>(out->positions.size());
          out->positions.push_back(vertices[slot].position);
          out->normals.push_back(vertices[slot].normal);
          out->patches.push_back(part.patchNumber);
          const glm::dvec2 a(part.corners.x, part.corners.y), b(part.corners.z, part.corners.w),
              c(part.lastU, part.lastV);
          const double x = double(i) / grid, y = double(j) / grid;
          const glm::dvec2 at = triangle ? (1.0 - x - y) * a + x * b + y * c : a + (b - a) * glm::dvec2(x, y);
          out->parameters.push_back(surfaces::domainPoint(
              triangle ? surfaces::Domain::Triangle : surfaces::Domain::Rectangle, at.x, at.y));
        }
    }
    for (const glm::uvec3& t : indices_->read<glm::uvec3>(0, int64_t{count} * 2 * grid * grid))
      if (t.x != t.y) out->triangles.emplace_back(places[t.x], places[t.y], places[t.z]);
    return out;
  }

  std::vector<Counter> count(frame::Frame& frame) override {
    const RecursionCounters counters = counters_->read<RecursionCounters>()[0];
    return {{"parts_tested", double(counters.tests)},
            {"faces", double(std::min(counters.finished, capacity_))},
            {"tessellated_triangles", double(tessellation(frame)->triangles.size())},
            {"parts_culled", double(counters.culled)},
            {"parts_cut_short", double(counters.cutShort)},
            {"parts_left_out", double(counters.leftOut)},
            {"recursion_steps", double(std::max(counters.rounds, 1U) - 1)}};
  }

  static std::vector<Quantity> quantities() {
    const Direction lower = Direction::LowerIsBetter;
    return {{"parts_tested", "Parts tested", "parts", lower},
            {"faces", "Finished parts", "faces", lower},
            {"tessellated_triangles", "Triangles made", "triangles", lower},
            {"parts_culled", "Parts culled", "parts", Direction::Neither},
            {"parts_cut_short", "Parts drawn although not flat", "parts", lower},
            {"parts_left_out", "Parts left out for want of capacity", "parts", lower},
            {"recursion_steps", "Splits from a patch to its smallest part", "steps", lower}};
  }

 private:
  static void refuseOtherDegrees(const surfaces::PatchSet& set) {
    for (const surfaces::Patch& patch : set.patches)
      if (patch.degreeU != 3 || patch.degreeV != 3)
        throw Error("the scene has patches that are not of degree 3", "scene",
                    "recursion/cpu splits patches of any degree");
  }

  static std::vector<RecursionPart> wholePatches(const surfaces::PatchSet& set) {
    std::vector<RecursionPart> out;
    for (uint32_t i = 0; i < set.patches.size(); ++i) {
      const bool triangle = set.patches[i].domain == surfaces::Domain::Triangle;
      out.push_back({triangle ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 0, 1, 1), 0.0F, 0.0F, i, 0});
    }
    return out;
  }

  /// Of a part before it is diced: cells of a smooth surface deviate less by the square of their number along
  /// a side.
  double partTolerance() const {
    return settings_.flatness == QueueFlatness::Extent
               ? settings_.tolerancePx
               : settings_.tolerancePx * settings_.grid * settings_.grid;
  }

  void split(frame::Frame& frame) {
    const auto scope = frame.passes().open("recursion/split");
    RecursionCounters start{};
    start.next = patches_->count();
    counters_->write(0, sizeof start, &start);
    glCopyNamedBufferSubData(first_->id(), queues_[0]->id(), 0, 0,
                             patches_->count() * int64_t{sizeof(RecursionPart)});
    const glm::vec2 half = 0.5F * glm::vec2(frame.sizePx());
    splitProgram_->set("anchorToClip", frame::anchorToClip(frame));
    splitProgram_->set("halfSize", half);
    splitProgram_->set("nearest", static_cast<float>(frame::nearPlane(frame)));
    splitProgram_->set("tolerance", static_cast<float>(partTolerance()));
    splitProgram_->set("partCapacity", capacity_);
    splitProgram_->set("mostSteps", static_cast<uint32_t>(settings_.mostSteps));
    splitProgram_->set("cull", settings_.cull ? 1 : 0);
    roundsProgram_->set("partCapacity", capacity_);
    roundsProgram_->set("indicesPerPart", static_cast<uint32_t>(6 * settings_.grid * settings_.grid));
    patches_->bindStorage();
    counters_->bindStorage(kSplitCountersBuffer);
    finished_->bindStorage(kFinishedBuffer);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, counters_->id());
    for (int round = 0; round <= settings_.mostSteps; ++round) {
      advance();
      queues_[static_cast<size_t>(round % 2)]->bindStorage(kQueueBuffer);
      queues_[static_cast<size_t>(1 - round % 2)]->bindStorage(kNextQueueBuffer);
      splitProgram_->use();
      glDispatchComputeIndirect(offsetof(RecursionCounters, groupsX));
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    advance();
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
  }

  void advance() const {
    roundsProgram_->use();
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  }

  void dice(frame::Frame& frame) {
    const auto scope = frame.passes().open("recursion/dice");
    diceProgram_->set("partCapacity", capacity_);
    diceProgram_->set("grid", settings_.grid);
    patches_->bindStorage();
    indices_->bindStorage(kIndicesBuffer);
    counters_->bindStorage(kDiceCountersBuffer);
    finished_->bindStorage(kFinishedBuffer);
    vertices_->bindStorage(kVerticesBuffer);
    diceProgram_->use();
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, counters_->id());
    glDispatchComputeIndirect(offsetof(RecursionCounters, diceGroupsX));
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
  }

  Settings settings_;
  std::optional<PatchBuffers> patches_;
  std::optional<SurfacePicture> picture_;
  const gl::Program *splitProgram_ = nullptr, *roundsProgram_ = nullptr, *diceProgram_ = nullptr,
                    *drawProgram_ = nullptr;
  std::optional<gl::Buffer> first_, finished_, counters_, vertices_, indices_;
  std::array<std::optional<gl::Buffer>, 2> queues_;
  std::optional<SurfaceVertexArray> array_;
  uint32_t capacity_ = 0;
};

const RegisteredTechnique<QueueRecursion> kQueueRecursionRegistered{
    {.name = "recursion/queues",
     .version = 2,
     .summary =
         "Curved surfaces split recursively in compute queues until parts are flat or small, then diced",
     .source = "Patney and Owens 2008; Schwarz 2009, section 7.2.5 (SC-38, SC-44)",
     .product = ProductKind::Colour,
     .needs = {"curved_surfaces"},
     .tessellates = true,
     .counters = QueueRecursion::quantities()}};

}  // namespace
}  // namespace limen::techniques
