// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/in_place_cuts.h"

#include <epoxy/gl.h>

#include <string>

#include "experiments/base/error.h"

namespace limen::many_lods {
namespace {

/// Shared memory that every device has, less what the scan takes.
constexpr int kSharedBytes = 32768 - 4 * kInPlaceGroup - 64;

int64_t sharedBytes(const InPlaceSettings& settings, int depth) {
  return 8 * int64_t{settings.finders} * (1 + depth + settings.finished);
}

const gl::Program& inPlaceProgram(gl::Context& context, uint32_t stack, const InPlaceSettings& settings,
                                  Discs discs) {
  gl::ShaderDefines defines = {{"FINDERS", std::to_string(settings.finders)},
                               {"FINISHED", std::to_string(settings.finished)},
                               {"STACK", std::to_string(stack)},
                               {"FLAG_SCAN", std::to_string(flagScanForm(settings.scan))}};
  defines.merge(discDefines(discs));
  if (settings.discard) defines["DISCARD"] = "1";
  return context.programs().compute("renderer/many_lods/in_place.comp.glsl", defines);
}

}  // namespace

int flagScanForm(FlagScan scan) {
  if (scan == FlagScan::Sweep) return 0;
  if (epoxy_has_gl_extension("GL_KHR_shader_subgroup")) {
    GLint stages = 0, features = 0;
    glGetIntegerv(GL_SUBGROUP_SUPPORTED_STAGES_KHR, &stages);
    glGetIntegerv(GL_SUBGROUP_SUPPORTED_FEATURES_KHR, &features);
    if ((stages & GL_COMPUTE_SHADER_BIT) != 0 && (features & GL_SUBGROUP_FEATURE_BALLOT_BIT_KHR) != 0)
      return 1;
  }
  if (epoxy_has_gl_extension("GL_ARB_shader_ballot") && epoxy_has_gl_extension("GL_ARB_gpu_shader_int64"))
    return 2;
  return 0;
}

const SettingsTable<InPlaceSettings>& InPlaceSettings::table() {
  using S = InPlaceSettings;
  static const SettingsTable<S> kTable = {
      {&S::finders, "finders", oneOf({32, 64, 128}), "", "Invocations of a group that find cuts",
       "Holländer 2013, table 3.3 (64 and 128)"},
      {&S::viewsPerGroup,
       "views_per_group",
       {1, 128},
       "",
       "Views that a group finds the cuts of",
       "Holländer 2013, section 3.7.2 (one for each finder)"},
      {&S::finished,
       "finished",
       {1, 8},
       "",
       "Nodes that wait to be drawn, for each finder",
       "Holländer 2013, section 3.7.2 (k)"},
      {&S::scan, "scan",
       "How a group counts nodes that are split or drawn; a ballot is the sweep where the driver has none",
       "Holländer 2013, section 3.7.1"},
      {&S::discard, "discard", "Find cuts and draw nothing, to time the one without the other",
       "Holländer 2013, table 3.3"}};
  return kTable;
}

void InPlaceSettings::check() const {
  if (viewsPerGroup > finders)
    throw Error(
        "a group has " + std::to_string(viewsPerGroup) + " views and " + std::to_string(finders) + " finders",
        "views_per_group", "give at most as many views as finders");
  if (sharedBytes(*this, kMostDepth) > kSharedBytes)
    throw Error("the stack takes " + std::to_string(sharedBytes(*this, kMostDepth)) +
                    " bytes of shared memory, more than all devices have",
                "finished", "lower 'finished' or 'finders'");
}

InPlaceCuts::InPlaceCuts(gl::Context& context, uint32_t views, int depth, const InPlaceSettings& settings,
                         Discs discs)
    : settings_(settings),
      views_(views),
      leaves_(1U << depth),
      stack_(static_cast<uint32_t>(settings.finders * (1 + depth))),
      counts_(int64_t{sizeof(InPlaceCounts)}, nullptr),
      program_(inPlaceProgram(context, stack_, settings, discs)) {}

void beginInPlace(const gl::Program& program, const gl::Buffer& nodes, const gl::Buffer& views,
                  const ViewAtlas& atlas, const ViewAtlas::Settings& settings, const gl::Buffer& counts) {
  atlas.clear();
  counts.clearUint(0);
  nodes.bindStorage(kCutNodesBuffer);
  views.bindStorage(kCutViewsBuffer);
  atlas.depths().bindStorage(kSplatDepthsBuffer);
  counts.bindStorage(kInPlaceCountsBuffer);
  if (settings.cones) settings.cones->bindStorage(kSplatConesBuffer);
  program.set("tilePx", atlas.tilePx());
  program.set("nearest", settings.nearest);
  program.set("radiusScale", settings.radiusScale);
  program.use();
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void InPlaceCuts::draw(const gl::Buffer& nodes, const gl::Buffer& views, const ViewAtlas& atlas,
                       const ViewAtlas::Settings& settings) const {
  const auto perGroup = static_cast<uint32_t>(settings_.viewsPerGroup);
  program_.set("leaves", leaves_);
  program_.set("viewCount", views_);
  program_.set("viewsPerGroup", perGroup);
  beginInPlace(program_, nodes, views, atlas, settings, counts_);
  glDispatchCompute((views_ + perGroup - 1) / perGroup, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

InPlaceCounts InPlaceCuts::counts() const { return counts_.read<InPlaceCounts>(0, 1)[0]; }

}  // namespace limen::many_lods
