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
      {&S::triangleRule, "triangle_rule", "Which bound gives the factors of cubic triangles",
       "Schwarz 2009, sections 7.4.3 and 7.4.4"},
      {&S::space, "space",
       "Where the deviation is bounded: in eye coordinates with each patch's own tolerance, in the scene's "
       "with that "
       "of its middle, or on the screen (rectangles)",
       "Abi-Ezzi and Shirman 1991; Schwarz 2009, section 7.4.2"},
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

const SettingsTable<BySize>& BySize::table() {
  using S = BySize;
  static const SettingsTable<S> kTable = {
      {&S::measure, "measure",
       "Of each side the distance of its ends (chord), or of all curves of a patch a bound on the speed: the "
       "degree "
       "times the longest step between control points (rockwood), or between any coordinates of these "
       "(kumar), "
       "which "
       "bounds secants as well",
       "Schwarz 2009, section 7.4.1"},
      {&S::segmentPx, "segment_px", {0.25, 256.0}, "px", "Size that a segment may have"},
      {&S::most, "most", {1, 64}, "segments", "Most segments of a side"}};
  return kTable;
}

int FactorSettings::mostSegments() const {
  if (const auto* uniform = std::get_if<BySegments>(&factors)) return uniform->segments;
  if (const auto* size = std::get_if<BySize>(&factors)) return size->most;
  return std::get<ByDeviation>(factors).most;
}

const SettingsTable<FactorSettings>& FactorSettings::table() {
  using S = FactorSettings;
  static const SettingsTable<S> kTable = {
      {&S::factors, "factors", "Segments along the sides of patches"},
      {&S::cull, "cull", "Leave out patches outside the view", "Schwarz 2009, section 7.6.2"},
      {&S::cornerFix, "corner_fix", "Correct the shape of triangles where two transitions meet",
       "Schwarz 2009, section 7.3 (off in section 7.6.2, for simplicity)"},
      {&S::precompute, "precompute",
       "Make boxes and bounds of patches once, not in every frame; boxes and bounds of rational patches are "
       "then "
       "somewhat larger",
       "Schwarz 2009, section 7.6.3"}};
  return kTable;
}

namespace {

gl::ShaderDefines factorDefines(gl::ShaderDefines defines, const FactorSettings& settings) {
  const auto* deviation = std::get_if<ByDeviation>(&settings.factors);
  defines["RULE"] = std::to_string(deviation ? static_cast<int>(deviation->rule) : surfaces::kRuleGuthe);
  if (deviation && deviation->triangleRule != TriangleRule::Sides)
    defines["PN_CONSTANT"] = std::to_string(
        surfaces::constantOf(deviation->triangleRule == TriangleRule::PnEstimate ? surfaces::PnBound::Boundary
                             : deviation->triangleRule == TriangleRule::PnTied   ? surfaces::PnBound::Tied
                                                                                 : surfaces::PnBound::Safe));
  if (deviation && deviation->space == FactorSpace::Screen) defines["SCREEN"] = "1";
  if (const auto* size = std::get_if<BySize>(&settings.factors))
    defines["SIZE"] = std::to_string(static_cast<int>(size->measure));
  return defines;
}

gl::ShaderDefines with(gl::ShaderDefines defines, const char* name, bool wanted = true) {
  if (wanted) defines[name] = "1";
  return defines;
}

gl::ShaderDefines countDefinesOf(gl::ShaderDefines defines, bool lists, Spacing spacing) {
  defines["SPACING"] = std::to_string(static_cast<int>(spacing));
  return with(std::move(defines), "LISTS", lists);
}

constexpr const char* kFactors = "renderer/techniques/tessellation/factors.comp.glsl";

}  // namespace

FactorPass::FactorPass(frame::Frame& frame, const PatchBuffers& patches, const FactorSettings& settings,
                       bool lists, Spacing spacing)
    : patches_(patches),
      settings_(settings),
      countDefines_(countDefinesOf(patches.defines(), lists, spacing)),
      factorsProgram_(frame.context().programs().compute(
          kFactors, with(factorDefines(patches.defines(), settings), "BOUNDS_MADE", settings.precompute))),
      countsProgram_(frame.context().programs().compute("renderer/techniques/tessellation/counts.comp.glsl",
                                                        countDefines_)),
      own_(int64_t{patches.count()} * 8, nullptr),
      factors_(int64_t{patches.count()} * int64_t{sizeof(PatchFactors)}, nullptr),
      counts_(compute::PrefixSum::bytesFor(patches.count(), 2), nullptr),
      bounds_((settings.precompute ? int64_t{patches.count()} : 1) * int64_t{sizeof(PatchBounds)}, nullptr) {
  requireBounds(frame.scene());
  const bool moving = patches.motions() != nullptr;
  if (moving)
    moveProgram_ =
        &frame.context().programs().compute("renderer/techniques/tessellation/move_points.comp.glsl");
  if (!settings.precompute) return;
  patches_.bindStorage();
  if (moving) patches_.motions()->bindStorage(kPointMotionsBuffer);
  bounds_.bindStorage(kPatchBoundsBuffer);
  dispatch(frame.context().programs().compute(
      kFactors, with(with(factorDefines(patches.defines(), settings), "MAKE_BOUNDS"), "MOVING", moving)));
}

void FactorPass::requireBounds(const scene::Scene& scene) const {
  if (settings_.precompute && std::holds_alternative<BySize>(settings_.factors))
    throw Error("sizes on the screen depend on the view", "precompute", "leave it off");
  const auto* deviation = std::get_if<ByDeviation>(&settings_.factors);
  if (!deviation || deviation->space != FactorSpace::Screen) return;
  if (settings_.precompute)
    throw Error("bounds on the screen depend on the view", "precompute",
                "leave it off, or use another factors.space");
  for (const surfaces::Patch& patch : scene.surfaces.patches)
    if (patch.domain == surfaces::Domain::Triangle)
      throw Error("no bound is known of projected triangles", "factors.space", "use lighting or object");
}

void FactorPass::dispatch(const gl::Program& program) const {
  program.set("patchCount", patches_.count());
  program.use();
  const uint32_t groups =
      (patches_.count() + uint32_t(kTessellationGroup) - 1) / uint32_t(kTessellationGroup);
  glDispatchCompute(groups, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void FactorPass::runFactors(frame::Frame& frame, const gl::Program& program) const {
  const auto* deviation = std::get_if<ByDeviation>(&settings_.factors);
  const auto* uniform = std::get_if<BySegments>(&settings_.factors);
  program.set("anchorToCamera", glm::mat4(frame.anchorToCamera()));
  program.set("rayScale", glm::vec2(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()));
  program.set("nearest", static_cast<float>(frame::nearPlane(frame)));
  if (deviation)
    program.set("tolerance", static_cast<float>(surfaces::objectTolerance(
                                 deviation->tolerancePx, 1.0, frame.tanHalfFov(), frame.sizePx().y)));
  const glm::dmat4 toCamera = frame.anchorToCamera();
  program.set("commonDepth", deviation && deviation->space == FactorSpace::Object
                                 ? static_cast<float>(-toCamera[3].z)
                                 : 0.0F);
  program.set("pxAtDistance", static_cast<float>(frame.sizePx().y / (2.0 * frame.tanHalfFov())));
  program.set("tolerancePx", deviation ? static_cast<float>(deviation->tolerancePx) : 0.0F);
  if (const auto* size = std::get_if<BySize>(&settings_.factors))
    program.set("segmentPx", static_cast<float>(size->segmentPx));
  program.set("mostSegments", uniform ? kMostSegments : settings_.mostSegments());
  program.set("uniformSegments", uniform ? uniform->segments : 0);
  program.set("cull", settings_.cull ? 1 : 0);
  program.set("strict", deviation && deviation->strict ? 1 : 0);
  dispatch(program);
}

int64_t FactorPass::countCapped(frame::Frame& frame) const {
  gl::ShaderDefines defines =
      with(factorDefines(patches_.defines(), settings_), "BOUNDS_MADE", settings_.precompute);
  defines["COUNT_CAPPED"] = "1";
  const gl::Buffer flags(own_.bytes(), nullptr);
  patches_.bindStorage();
  flags.bindStorage(kOwnFactorsBuffer);
  bounds_.bindStorage(kPatchBoundsBuffer);
  runFactors(frame, frame.context().programs().compute(kFactors, defines));
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  int64_t out = 0;
  for (const glm::uvec2& flag : flags.read<glm::uvec2>(0, patches_.count())) out += flag.x;
  return out;
}

void FactorPass::movePoints(frame::Frame& frame) const {
  const auto scope = frame.passes().open("tessellation/motion");
  patches_.motions()->bindStorage(kPointMotionsBuffer);
  moveProgram_->set("wave", glm::vec2(frame.scene().surfaces.motion.waveAt(frame.timeS())));
  moveProgram_->set("pointCount", patches_.pointCount());
  moveProgram_->use();
  const uint32_t groups =
      (patches_.pointCount() + uint32_t(kTessellationGroup) - 1) / uint32_t(kTessellationGroup);
  glDispatchCompute(groups, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void FactorPass::runFirst(frame::Frame& frame) const {
  patches_.bindStorage();
  if (moveProgram_) movePoints(frame);
  patches_.bindStorage();
  own_.bindStorage(kOwnFactorsBuffer);
  bounds_.bindStorage(kPatchBoundsBuffer);
  const auto scope = frame.passes().open("tessellation/factors");
  runFactors(frame, factorsProgram_);
}

void FactorPass::run(frame::Frame& frame) const {
  runFirst(frame);
  const auto scope = frame.passes().open("tessellation/counts");
  factors_.bindStorage(kFactorsBuffer);
  counts_.bindStorage(kSlotCountsBuffer);
  countsProgram_.set("cornerFix", settings_.cornerFix ? 1 : 0);
  dispatch(countsProgram_);
}

}  // namespace limen::techniques
