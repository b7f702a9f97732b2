// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/voxel_cone_tracing/radiance_pyramid.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <string>

#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/techniques/global_illumination/illumination_bindings.h"
#include "renderer/techniques/global_illumination/light_box.h"
#include "renderer/techniques/global_illumination/surface_light.h"
#include "renderer/techniques/global_illumination/voxel_dispatch.h"
#include "renderer/techniques/global_illumination/voxel_propagation/surface_samples.h"

namespace limen::techniques {
namespace {

const std::string kConeFolder = "renderer/techniques/global_illumination/voxel_cone_tracing/";
constexpr int kMostLevels = 6;

int levelsOf(int resolution) {
  return std::min(static_cast<int>(std::bit_width(static_cast<uint32_t>(resolution))) - 1, kMostLevels);
}

}  // namespace

const SettingsTable<ConeSettings>& ConeSettings::table() {
  using S = ConeSettings;
  constexpr const char* kPaper = "Crassin et al. 2011";
  static const SettingsTable<S> kTable = {
      {&S::start,
       "start",
       {0.0, 4.0},
       "voxels",
       "From a surface to where its cones start, along its normal",
       kPaper},
      {&S::step,
       "step",
       {0.1, 2.0},
       "",
       "From one place of a cone to the next, in the cone's width there",
       kPaper},
      {&S::width,
       "width",
       {0.05, 2.0},
       "",
       "Of the voxels that a cone reads, over their distance: 1.15 is that of 60 degrees, whose voxels hold "
       "much of the surface that the cone starts from",
       kPaper}};
  return kTable;
}

const SettingsTable<RadiancePyramidSettings>& RadiancePyramidSettings::table() {
  using S = RadiancePyramidSettings;
  constexpr const char* kPaper = "Crassin et al. 2011";
  static const SettingsTable<S> kTable = {
      {&S::resolution, "resolution", {8, 128}, "voxels", "Along the longest side of the scene's box", kPaper},
      {&S::bounces,
       "bounces",
       {1, 8},
       "",
       "Reflections between surfaces, after the one of the lamp's light",
       "the bench's own"},
      {&S::samplesAside,
       "samples_aside",
       {1, 16},
       "",
       "Points of a surface along the side of a voxel, at least",
       "the bench's own"},
      {&S::cones, "cones", "Six cones about each point's normal"}};
  return kTable;
}

RadiancePyramid::RadiancePyramid(frame::Frame& frame, const RadiancePyramidSettings& settings,
                                 const frame::SurfaceLightSettings& lighting)
    : settings_(settings), lighting_(lighting), rays_(frame) {
  gl::Context& context = frame.context();
  gl::ProgramCache& programs = context.programs();
  const int levels = levelsOf(settings.resolution);
  volume_.emplace(context, lightBox(frame.scene(), settings.resolution, 1 << (levels - 1)),
                  frame.gpuScene().anchor(), voxels::VolumeAttributes{true, true, gl::Format::RGBA16F});
  voxelizer_.emplace(frame, voxels::Coverage::Thin, *volume_);
  gl::ShaderDefines lit = surfaceLightDefines(lighting, frame);
  lit.merge(volume_->defines());
  inject_ = &programs.compute(kConeFolder + "face_light.comp.glsl", lit);
  gl::ShaderDefines bouncing = volume_->defines();
  base_ = &programs.compute(kConeFolder + "radiance_base.comp.glsl", bouncing);
  bouncing["BOUNCE"] = "1";
  bounce_ = &programs.compute(kConeFolder + "radiance_base.comp.glsl", bouncing);
  level_ = &programs.compute(kConeFolder + "radiance_level.comp.glsl");

  const voxels::VoxelGrid& grid = volume_->grid();
  const double h = grid.voxelSize;
  const SampleTexture samples = sampleTexture(frame.scene(), h / settings.samplesAside, h * h);
  sampleCount_ = samples.count;
  samples_.emplace(gl::Format::RGBA32UI, samples.sizePx);
  samples_->writeUint(samples.texels);
  sums_.emplace(grid.count() * int64_t{kFaceSums} * 4, nullptr);
  for (int i = 0; i < 12; ++i) faces_.emplace_back(gl::Format::RGBA16F, grid.resolution, levels);
  for (const gl::VolumeTexture& face : faces_) face.clear(glm::vec4(0.0F));
}

int64_t RadiancePyramid::bytes() const {
  return volume_->bytes() + samples_->bytes() + sums_->bytes() + 12 * faces_[0].bytes();
}

void RadiancePyramid::configure(const gl::Program& program) const {
  volume_->configure(program);
  for (size_t face = 0; face < 6; ++face)
    faces_[6 * now_ + face].bindTexture(kRadianceUnit + static_cast<uint32_t>(face));
  program.set("coneStart", static_cast<float>(settings_.cones.start));
  program.set("coneStep", static_cast<float>(settings_.cones.step));
  program.set("coneWidth", static_cast<float>(settings_.cones.width));
  program.set("mostLevel", faces_[0].levels() - 1);
}

void RadiancePyramid::makeLevels() const {
  for (int level = 1; level < faces_[0].levels(); ++level) {
    level_->set("level", level - 1);
    for (size_t face = 0; face < 6; ++face) {
      const gl::VolumeTexture& texture = faces_[6 * now_ + face];
      level_->set("face", static_cast<int>(face));
      texture.bindTexture(kRadianceUnit);
      texture.bindImage(kRadianceFacesImage, gl::Access::Write, level);
      level_->use();
      const glm::ivec3 groups = (texture.size(level) + kPropagateGroup - 1) / kPropagateGroup;
      glDispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y),
                        static_cast<GLuint>(groups.z));
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }
}

void RadiancePyramid::make(frame::Frame& frame) {
  rays_.build(frame);
  {
    const auto scope = frame.passes().open("global_illumination/voxelize");
    voxelizer_->run(frame, *volume_);
  }
  {
    const auto scope = frame.passes().open("global_illumination/inject");
    sums_->clearUint(0);
    configureSurfaceLight(*inject_, frame, lighting_, rays_.tree());
    volume_->configure(*inject_);
    inject_->set("sampleCount", sampleCount_);
    samples_->bindTexture(kInjectSamplesUnit);
    sums_->bindStorage(kFaceSumsBuffer);
    inject_->dispatch(samples_->sizePx());
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  const auto scope = frame.passes().open("global_illumination/pyramid");
  for (int bounce = 0; bounce < settings_.bounces; ++bounce) {
    const gl::Program& program = bounce == 0 ? *base_ : *bounce_;
    configure(program);
    now_ = 1 - now_;
    for (size_t face = 0; face < 6; ++face)
      faces_[6 * now_ + face].bindImage(kRadianceFacesImage + static_cast<uint32_t>(face), gl::Access::Write);
    sums_->bindStorage(kFaceSumsBuffer);
    program.use();
    dispatchVoxels(volume_->grid().resolution);
    makeLevels();
  }
}

}  // namespace limen::techniques
