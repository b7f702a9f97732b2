// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/subdivision/fragments/fragment_refinement.h"

#include <epoxy/gl.h>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/subdivision/subdivision_bindings.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {

const SettingsTable<FlatLevels>& FlatLevels::table() {
  using S = FlatLevels;
  static const SettingsTable<S> kTable = {
      {&S::tolerancePx,
       "tolerance_px",
       {0.01, 64.0},
       "px",
       "Distance on the screen that a fragment of bicubic patches may keep from its triangles",
       "bench, by the bound of Filip, Magedson and Markot 1986 (Bunnell 2005: differences of control "
       "points)"}};
  return kTable;
}

namespace {

const gl::Program& fragmentProgram(gl::Context& context, const char* name,
                                   const gl::ShaderDefines& defines = {}) {
  return context.programs().compute(
      std::string("renderer/techniques/subdivision/fragments/") + name + ".comp.glsl", defines);
}

gl::ShaderDefines listing(const FlatLevels* flat) {
  return flat ? gl::ShaderDefines{{"LISTED", "1"}} : gl::ShaderDefines{};
}

int64_t fittingBytes(int64_t count, int64_t bytesEach) {
  const int64_t bytes = count * bytesEach;
  if (bytes > int64_t{3} << 30)
    throw Error("fragments at the finest level do not fit into a buffer", "level", "use a lower level");
  return (bytes + 15) / 16 * 16;
}

}  // namespace

FragmentRefinement::FragmentRefinement(gl::Context& context, const FragmentLayout& layout, int steps,
                                       const FlatLevels* flat)
    : count_(static_cast<uint32_t>(layout.fragments.size())),
      ringPoints_(layout.ringPoints),
      steps_(steps),
      flat_(flat ? std::optional(*flat) : std::nullopt),
      gather_(fragmentProgram(context, "gather")),
      refine_(fragmentProgram(context, "refine", listing(flat))),
      limits_(fragmentProgram(context, "limits", listing(flat))),
      levelsProgram_(fragmentProgram(context, "levels",
                                     flat ? gl::ShaderDefines{} : gl::ShaderDefines{{"UNIFORM", "1"}})),
      indicesProgram_(fragmentProgram(context, "indices")),
      lists_(fragmentProgram(context, "lists")),
      dispatches_(fragmentProgram(context, "dispatches")),
      listBuffer_(flat ? fittingBytes(int64_t{count_} * (steps + 1), 4) : 16, nullptr),
      dispatchBuffer_(std::vector<FragmentDispatch>(static_cast<size_t>(steps) + 1)),
      fragments_(layout.fragments),
      controls_(layout.controls),
      points_{gl::Buffer(fittingBytes(count_ * pointsOf(steps - steps % 2), 16), nullptr),
              gl::Buffer(fittingBytes(count_ * pointsOf(std::max(steps - 1 + steps % 2, 0)), 16), nullptr)},
      levels_(fittingBytes(count_, 4), nullptr),
      counts_(compute::PrefixSum::bytesFor(count_, 2), nullptr),
      offsets_(compute::PrefixSum::bytesFor(count_, 2), nullptr),
      vertices_(fittingBytes(((int64_t{1} << steps) + 1) * ((int64_t{1} << steps) + 1) * count_,
                             int64_t{sizeof(TessellatedVertex)}),
                nullptr),
      indices_(fittingBytes(int64_t{6} * count_ << (2 * steps), 4), nullptr),
      totals_(int64_t{sizeof(AdaptiveTotals)}, nullptr),
      scan_(context, count_, 2) {
  if (flat) return;
  configure(levelsProgram_, 0);
  list();
}

int64_t FragmentRefinement::pointsOf(int level) const {
  const int64_t row = (int64_t{1} << level) + 3;
  return row * row + ringPoints_;
}

int64_t FragmentRefinement::bytes() const {
  return fragments_.bytes() + controls_.bytes() + points_[0].bytes() + points_[1].bytes() + levels_.bytes() +
         counts_.bytes() + offsets_.bytes() + vertices_.bytes() + indices_.bytes() + scan_.bytes() +
         listBuffer_.bytes() + dispatchBuffer_.bytes();
}

void FragmentRefinement::configure(const gl::Program& program, int level) const {
  program.use();
  program.set("fragmentCount", count_);
  program.set("ringPoints", ringPoints_);
  program.set("segments", 1 << level);
  fragments_.bindStorage(kFragmentsBuffer);
  points_[level % 2].bindStorage(kFragmentPointsBuffer);
  points_[(level + 1) % 2].bindStorage(kFragmentTargetBuffer);
  levels_.bindStorage(kFragmentLevelsBuffer);
}

void FragmentRefinement::dispatch(const gl::Program& program, int64_t invocations) {
  program.use();
  const auto groups = static_cast<uint32_t>((invocations + kFragmentGroup - 1) / kFragmentGroup);
  const uint32_t rows = (groups + 65534) / 65535;
  glDispatchCompute((groups + rows - 1) / rows, rows, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void FragmentRefinement::dispatchLevel(const gl::Program& program, int level, int64_t each,
                                       size_t groups) const {
  if (!flat_) {
    dispatch(program, each * count_);
    return;
  }
  listBuffer_.bindStorage(kFragmentListsBuffer);
  dispatchBuffer_.bindStorage(kFragmentDispatchesBuffer);
  program.use();
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, dispatchBuffer_.id());
  glDispatchComputeIndirect(
      static_cast<GLintptr>(static_cast<size_t>(level) * sizeof(FragmentDispatch) + groups));
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

/// Levels, where vertices and triangles go, and the triangles; levelsProgram_ is configured.
void FragmentRefinement::list() const {
  levelsProgram_.set("mostLevel", static_cast<uint32_t>(steps_));
  counts_.bindStorage(kFragmentCountsBuffer);
  dispatch(levelsProgram_, count_);
  scan_.run(counts_, offsets_, count_);
  if (flat_) {
    lists_.use();
    lists_.set("fragmentCount", count_);
    levels_.bindStorage(kFragmentLevelsBuffer);
    listBuffer_.bindStorage(kFragmentListsBuffer);
    dispatchBuffer_.bindStorage(kFragmentDispatchesBuffer);
    dispatch(lists_, count_);
    dispatches_.use();
    dispatches_.set("mostLevel", static_cast<uint32_t>(steps_));
    dispatches_.set("ringPoints", ringPoints_);
    dispatch(dispatches_, 1);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
  }
  indicesProgram_.use();
  indicesProgram_.set("fragmentCount", count_);
  levels_.bindStorage(kFragmentLevelsBuffer);
  offsets_.bindStorage(kFragmentOffsetsBuffer);
  indices_.bindStorage(kFragmentIndicesBuffer);
  totals_.bindStorage(kFragmentTotalsBuffer);
  dispatch(indicesProgram_, int64_t{count_} * kFragmentGroup);
}

void FragmentRefinement::run(frame::Frame& frame, const gl::Buffer& controls) const {
  const auto limits = [&](int level) {
    configure(limits_, level);
    limits_.set("level", static_cast<uint32_t>(level));
    offsets_.bindStorage(kFragmentOffsetsBuffer);
    vertices_.bindStorage(kFragmentVerticesBuffer);
    const int64_t row = (int64_t{1} << level) + 1;
    dispatchLevel(limits_, level, row * row, offsetof(FragmentDispatch, limitGroups));
  };
  {
    const auto scope = frame.passes().open("subdivision/refine");
    points_[0].bindStorage(kFragmentTargetBuffer);
    controls_.bindStorage(kFragmentControlsBuffer);
    controls.bindStorage(kControlsBuffer);
    gather_.use();
    const int64_t points = count_ * pointsOf(0);
    gather_.set("pointCount", static_cast<uint32_t>(points));
    dispatch(gather_, points);
  }
  if (flat_) {
    const auto scope = frame.passes().open("subdivision/levels");
    configure(levelsProgram_, 0);
    levelsProgram_.set("eye", glm::vec3(frame.camera().eye - frame.gpuScene().anchor()));
    levelsProgram_.set("pxAtDistance", static_cast<float>(frame.sizePx().y / (2.0 * frame.tanHalfFov())));
    levelsProgram_.set("nearest", static_cast<float>(frame::nearPlane(frame)));
    levelsProgram_.set("tolerancePx", static_cast<float>(flat_->tolerancePx));
    list();
  }
  for (int level = 0;; ++level) {
    if (flat_ || level == 0 || level == steps_) {
      const auto scope = frame.passes().open("subdivision/limits");
      limits(level);
    }
    if (level == steps_) break;
    const auto scope = frame.passes().open("subdivision/refine");
    configure(refine_, level);
    refine_.set("sourceLevel", static_cast<uint32_t>(level));
    dispatchLevel(refine_, level + 1, pointsOf(level + 1), offsetof(FragmentDispatch, stepGroups));
  }
}

std::vector<uint32_t> FragmentRefinement::fragmentsByLevel() const {
  std::vector<uint32_t> out(static_cast<size_t>(steps_) + 1, 0);
  for (const uint32_t packed : levels_.read<uint32_t>(0, count_)) ++out[packed & 15U];
  return out;
}

double FragmentRefinement::pointsMade() const {
  const std::vector<uint32_t> fragments = fragmentsByLevel();
  double out = 0.0;
  for (int level = 0; level <= steps_; ++level)
    for (int of = level; of <= steps_; ++of)
      out += double(fragments[static_cast<size_t>(of)]) * double(pointsOf(level));
  return out;
}

}  // namespace limen::techniques
