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
#include "renderer/techniques/recursion/diced_parts.h"
#include "renderer/techniques/recursion/part_settings.h"
#include "renderer/techniques/recursion/recursion_bindings.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/tessellation/surface_view.h"

namespace limen::techniques {
namespace {

class QueueRecursion : public Technique {
 public:
  using Settings = PartSettings;
  explicit QueueRecursion(const PartSettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    requireCubic(frame.scene().surfaces);
    patches_.emplace(frame.scene(), frame.gpuScene().anchor());
    diced_.emplace(frame, *patches_, settings_);
    splitProgram_ = &frame.context().programs().compute(
        "renderer/techniques/recursion/queues/split.comp.glsl", settings_.defines(patches_->defines()));
    first_.emplace(wholePatches(frame.scene().surfaces));
    const int64_t bytes = diced_->partCapacity() * int64_t{sizeof(RecursionPart)};
    for (auto& queue : queues_) queue.emplace(bytes, nullptr);
    finished_.emplace(bytes, nullptr);
    counters_.emplace(int64_t{sizeof(RecursionCounters)}, nullptr);
    frame.passes().setBytesHeld("recursion/split", patches_->bytes() + first_->bytes() + 3 * bytes);
  }

  void render(frame::Frame& frame) override {
    split(frame);
    diced_->render(frame, *finished_, *counters_);
  }

  const gl::Texture& product() const override { return diced_->picture(); }

  std::shared_ptr<const surfaces::TessellatedSurface> tessellation(frame::Frame& frame) override {
    return diced_->surface(frame, *finished_, *counters_);
  }

  std::vector<Counter> count(frame::Frame& frame) override {
    const RecursionCounters counters = counters_->read<RecursionCounters>()[0];
    return {{"parts_tested", double(counters.tests)},
            {"faces", double(std::min(counters.finished, diced_->partCapacity()))},
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
  void split(frame::Frame& frame) {
    const auto scope = frame.passes().open("recursion/split");
    RecursionCounters start{};
    start.next = patches_->count();
    counters_->write(0, sizeof start, &start);
    glCopyNamedBufferSubData(first_->id(), queues_[0]->id(), 0, 0,
                             patches_->count() * int64_t{sizeof(RecursionPart)});
    settings_.setUniforms(*splitProgram_, frame);
    splitProgram_->set("partCapacity", diced_->partCapacity());
    patches_->bindStorage();
    counters_->bindStorage(kSplitCountersBuffer);
    finished_->bindStorage(kFinishedBuffer);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, counters_->id());
    for (int round = 0; round <= settings_.mostSteps; ++round) {
      diced_->advance(*counters_);
      queues_[static_cast<size_t>(round % 2)]->bindStorage(kQueueBuffer);
      queues_[static_cast<size_t>(1 - round % 2)]->bindStorage(kNextQueueBuffer);
      splitProgram_->use();
      glDispatchComputeIndirect(offsetof(RecursionCounters, groupsX));
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    diced_->advance(*counters_);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
  }

  Settings settings_;
  std::optional<PatchBuffers> patches_;
  std::optional<DicedParts> diced_;
  const gl::Program* splitProgram_ = nullptr;
  std::optional<gl::Buffer> first_, finished_, counters_;
  std::array<std::optional<gl::Buffer>, 2> queues_;
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
