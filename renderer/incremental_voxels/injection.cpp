// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/incremental_voxels/injection.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "renderer/incremental_voxels/incremental_bindings.h"

namespace limen::incremental_voxels {
namespace {

gl::ShaderDefines samplingDefines(const PointSettings& settings, const SampledVolume& volume, int views,
                                  int used) {
  gl::ShaderDefines defines = volume.defines();
  defines["VIEWS"] = std::to_string(views);
  defines["USED_VIEWS"] = std::to_string(used);
  defines.merge(pointDefines(settings));
  return defines;
}

constexpr GLuint kMostSampleGroups = 65535;

/// Units in 1 of sums of as many samples as there may be, all in one voxel: they stay below 2^30.
float unitsFor(int64_t samples, double largest) {
  const int bits = std::bit_width(static_cast<uint64_t>(std::max<int64_t>(samples, 1)));
  return static_cast<float>(std::exp2(std::min(30 - bits, 16)) / std::max(largest, 1e-30));
}

}  // namespace

const SettingsTable<PointSettings>& PointSettings::table() {
  using S = PointSettings;
  static const SettingsTable<S> kTable = {
      {&S::side,
       "side",
       {1, 1024},
       "points",
       "Points of the grid along each side of an image",
       "Gaitatzes 2012, section 7.6 (128)"},
      {&S::pattern, "pattern", "Order and places of the points", "Gaitatzes 2012, section 7.6"},
      {&S::subsets,
       "subsets",
       {1, 64},
       "",
       "Interleaved subsets of the grid, one a frame; 1: all points in each frame",
       "Gaitatzes 2012, section 7.8"},
      {&S::shift, "shift",
       "Points move within their cells from frame to frame, so that none is missed for good"}};
  return kTable;
}

gl::ShaderDefines pointDefines(const PointSettings& settings) {
  gl::ShaderDefines defines;
  defineEnum(defines, "POINTS", settings.pattern);
  return defines;
}

void configurePoints(const gl::Program& program, const PointSettings& settings, int step) {
  program.set("pointsPerSide", settings.side);
  program.set("subsets", settings.subsets);
  program.set("subset", step % settings.subsets);
  // Evenly spread from any step on (Roberts 2018, R2); a round of subsets has one shift.
  const double round = settings.shift ? step / settings.subsets : 0.0;
  const glm::dvec2 shift =
      glm::fract(glm::dvec2(0.5) + round * glm::dvec2(0.7548776662466927, 0.5698402909980532));
  program.set("pointShift", glm::vec2(shift));
}

void configureSampleLights(const gl::Program& program, const frame::Frame& frame,
                           const SampleLighting& lighting) {
  if (!frame.scene().lights.empty())
    program.set("lightPosition", glm::vec3(frame.scene().lights[0].centre - frame.gpuScene().anchor()));
  program.set("lightStrength", static_cast<float>(lighting.strength));
  frame.bindSurfaces();
  frame.gpuScene().bindStorage(&frame.positions());
}

Injection::Injection(gl::Context& context, const PointSettings& settings, const SampledVolume& volume,
                     int views, int used)
    : settings_(settings),
      used_(used),
      inject_(context.programs().compute("renderer/incremental_voxels/inject_samples.comp.glsl",
                                         samplingDefines(settings, volume, views, used))) {
  if (volume.hasAttributes())
    settle_ = &context.programs().compute("renderer/incremental_voxels/settle_samples.comp.glsl",
                                          samplingDefines(settings, volume, views, used));
}

void Injection::run(const frame::Frame& frame, const SampledVolume& volume,
                    const std::vector<DepthView>& views, const SampleLighting& lighting, int step) const {
  const int64_t samples = settings_.perStep() * used_;
  const float units = unitsFor(samples, 1.0), lightUnits = unitsFor(samples, lighting.brightest);
  const auto dispatch = [&](const gl::Program& program, int64_t count, int layers) {
    if (volume.hasAttributes()) {
      volume.sums().bindStorage(kSampleSumsBuffer);
      program.set("placeMask", volume.places() - 1);
      program.set("sampleScale", units);
      program.set("lightScale", lightUnits);
    }
    program.use();
    const auto groups = static_cast<GLuint>((count + kSampleGroup - 1) / kSampleGroup);
    glDispatchCompute(std::min(groups, kMostSampleGroups),
                      (groups + kMostSampleGroups - 1) / kMostSampleGroups, static_cast<GLuint>(layers));
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT);
  };
  volume.bind(inject_);
  configureViews(inject_, views, volume.grid(), frame.gpuScene().anchor());
  configurePoints(inject_, settings_, step);
  if (volume.hasAttributes()) configureSampleLights(inject_, frame, lighting);
  dispatch(inject_, settings_.perStep(), used_);
  if (!settle_) return;
  volume.bind(*settle_);
  dispatch(*settle_, volume.places(), 1);
}

}  // namespace limen::incremental_voxels
