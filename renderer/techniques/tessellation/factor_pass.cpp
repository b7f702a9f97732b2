// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/tessellation/factor_pass.h"

#include <epoxy/gl.h>

#include "renderer/compute/prefix_sum.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {

const SettingsTable<ByDeviation>& ByDeviation::table() {
  using S = ByDeviation;
  static const SettingsTable<S> kTable = {
      {&S::tolerancePx,
       "tolerance_px",
       {0.01, 64.0},
       "px",
       "Largest distance from the surface, at the depth of the patch's nearest control point",
       "Schwarz 2009, section 7.4 (0.5 px in all results)"},
      {&S::rule, "rule", "How a bound is divided between the two directions of a rectangle",
       "Schwarz 2009, section 7.4.2"},
      {&S::strict, "strict",
       "Allow for displacements away from the middle of the picture, which look larger than their size"},
      {&S::most, "most", {1, 64}, "segments", "Most segments of a side"}};
  return kTable;
}

const SettingsTable<BySegments>& BySegments::table() {
  using S = BySegments;
  static const SettingsTable<S> kTable = {
      {&S::segments, "segments", {1, 64}, "segments", "Segments of every side"}};
  return kTable;
}

const SettingsTable<FactorSettings>& FactorSettings::table() {
  using S = FactorSettings;
  static const SettingsTable<S> kTable = {
      {&S::factors, "factors", "Segments along the sides of patches"},
      {&S::cull, "cull", "Leave out patches outside the view", "Schwarz 2009, section 7.6.2"},
      {&S::cornerFix, "corner_fix", "Correct the shape of triangles where two transitions meet",
       "Schwarz 2009, section 7.3 (off in section 7.6.2, for simplicity)"}};
  return kTable;
}

namespace {

gl::ShaderDefines withRule(gl::ShaderDefines defines, const FactorSettings& settings) {
  const auto* deviation = std::get_if<ByDeviation>(&settings.factors);
  defines["RULE"] = std::to_string(deviation ? static_cast<int>(deviation->rule) : surfaces::kRuleGuthe);
  return defines;
}

gl::ShaderDefines withLists(gl::ShaderDefines defines, bool lists) {
  if (lists) defines["LISTS"] = "1";
  return defines;
}

}  // namespace

FactorPass::FactorPass(frame::Frame& frame, const PatchBuffers& patches, const FactorSettings& settings,
                       bool lists)
    : patches_(patches),
      settings_(settings),
      factorsProgram_(frame.context().programs().compute("renderer/techniques/tessellation/factors.comp.glsl",
                                                         withRule(patches.defines(), settings))),
      countsProgram_(frame.context().programs().compute("renderer/techniques/tessellation/counts.comp.glsl",
                                                        withLists(patches.defines(), lists))),
      own_(int64_t{patches.count()} * 4, nullptr),
      factors_(int64_t{patches.count()} * 4, nullptr),
      counts_(compute::PrefixSum::bytesFor(patches.count(), 2), nullptr) {}

void FactorPass::run(frame::Frame& frame) const {
  const auto dispatch = [&](const gl::Program& program) {
    program.set("patchCount", patches_.count());
    program.use();
    const uint32_t groups =
        (patches_.count() + uint32_t(kTessellationGroup) - 1) / uint32_t(kTessellationGroup);
    glDispatchCompute(groups, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  };
  patches_.bindStorage();
  own_.bindStorage(kOwnFactorsBuffer);
  {
    const auto scope = frame.passes().open("tessellation/factors");
    const auto* deviation = std::get_if<ByDeviation>(&settings_.factors);
    const auto* uniform = std::get_if<BySegments>(&settings_.factors);
    factorsProgram_.set("anchorToCamera", glm::mat4(frame.anchorToCamera()));
    factorsProgram_.set("rayScale", glm::vec2(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()));
    factorsProgram_.set("nearest", static_cast<float>(frame::nearPlane(frame)));
    if (deviation)
      factorsProgram_.set(
          "tolerance", static_cast<float>(surfaces::objectTolerance(deviation->tolerancePx, 1.0,
                                                                    frame.tanHalfFov(), frame.sizePx().y)));
    factorsProgram_.set("mostSegments", deviation ? deviation->most : kMostSegments);
    factorsProgram_.set("uniformSegments", uniform ? uniform->segments : 0);
    factorsProgram_.set("cull", settings_.cull ? 1 : 0);
    factorsProgram_.set("strict", deviation && deviation->strict ? 1 : 0);
    dispatch(factorsProgram_);
  }
  const auto scope = frame.passes().open("tessellation/counts");
  factors_.bindStorage(kFactorsBuffer);
  counts_.bindStorage(kSlotCountsBuffer);
  countsProgram_.set("cornerFix", settings_.cornerFix ? 1 : 0);
  dispatch(countsProgram_);
}

}  // namespace limen::techniques
