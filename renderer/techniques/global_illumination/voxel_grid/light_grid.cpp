// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/voxel_grid/light_grid.h"

#include <epoxy/gl.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/techniques/global_illumination/illumination_bindings.h"
#include "renderer/techniques/global_illumination/surface_light.h"
#include "renderer/techniques/global_illumination/voxel_grid/surface_samples.h"

namespace limen::techniques {
namespace {

constexpr int kSampleRow = 2048;            // samples a row of their texture
constexpr size_t kMostSamples = 4U << 20U;  // 64 MiB

const std::string kFolder = "renderer/techniques/global_illumination/voxel_grid/";

void overField(const voxels::VoxelGrid& grid) {
  const glm::ivec3 size(grid.resolution.x, grid.resolution.y, 3 * grid.resolution.z);
  const glm::ivec3 groups = (size + kPropagateGroup - 1) / kPropagateGroup;
  glDispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y),
                    static_cast<GLuint>(groups.z));
}

}  // namespace

const SettingsTable<LightGridSettings>& LightGridSettings::table() {
  using S = LightGridSettings;
  constexpr const char* kChapter = "Gaitatzes 2012, section 5.5.2";
  static const SettingsTable<S> kTable = {
      {&S::resolution,
       "resolution",
       {4, 128},
       "voxels",
       "Along the longest side of the scene's box",
       "Gaitatzes 2012, section 5.6 (32)"},
      {&S::iterations,
       "iterations",
       {0, 256},
       "",
       "Steps of a voxel that light travels",
       "Gaitatzes 2012, Table 2 (11, 12, 64)"},
      {&S::cone, "cone", "Directions that a neighbour takes light from", kChapter},
      {&S::shares, "shares", "How much of a voxel's light each neighbour takes", kChapter},
      {&S::exchange, "exchange", "Which neighbours an occupied voxel lights", "the bench's own"},
      {&S::reflection, "reflection", "At occupied voxels", kChapter},
      {&S::albedo, "albedo", "Of the reflection: stored, or .5 everywhere", "Gaitatzes 2012, section 5.7"},
      {&S::format, "format", "Of the fields"},
      {&S::coverage, "coverage", "Which voxels a triangle fills"},
      {&S::shift,
       "shift",
       {0.0, 2.0},
       "voxels",
       "Along its normal from a sample to where its light starts",
       "the bench's own"},
      {&S::samplesAside,
       "samples_aside",
       {1, 16},
       "",
       "Samples of a surface along the side of a voxel, at least",
       "the bench's own"}};
  return kTable;
}

LightGrid::LightGrid(frame::Frame& frame, const LightGridSettings& settings,
                     const frame::SurfaceLightSettings& lighting)
    : settings_(settings), lighting_(lighting) {
  gl::Context& context = frame.context();
  const gl::Format format = settings.format == FieldFormat::Half ? gl::Format::RGBA16F : gl::Format::RGBA32F;
  volume_.emplace(context, voxels::tightGrid(frame.scene().bounds(), settings.resolution),
                  frame.gpuScene().anchor(), voxels::VolumeAttributes{true, true, gl::Format::RGBA16F});
  voxelizer_.emplace(context, settings.coverage, *volume_);
  const voxels::VoxelGrid& grid = volume_->grid();
  const glm::ivec3 size = grid.resolution;

  gl::ShaderDefines defines = surfaceLightDefines(lighting, frame);
  defines.merge(volume_->defines());
  defineEnum(defines, "EXCHANGE", settings.exchange);
  inject_ = &context.programs().compute(kFolder + "inject.comp.glsl", defines);
  defines = volume_->defines();
  defines["FIELD_FORMAT"] = settings.format == FieldFormat::Half ? "rgba16f" : "rgba32f";
  seed_ = &context.programs().compute(kFolder + "seed.comp.glsl", defines);
  defineEnum(defines, "SHARES", settings.shares);
  defineEnum(defines, "EXCHANGE", settings.exchange);
  defineEnum(defines, "REFLECTION", settings.reflection);
  defineEnum(defines, "ALBEDO", settings.albedo);
  propagate_ = &context.programs().compute(kFolder + "propagate.comp.glsl", defines);

  const double h = grid.voxelSize;
  const std::vector<SurfaceSample> samples =
      sampleSurfaces(frame.scene(), h / settings.samplesAside, kMostSamples);
  sampleCount_ = static_cast<uint32_t>(samples.size());
  const int rows = std::max(1, static_cast<int>((samples.size() + kSampleRow - 1) / kSampleRow));
  samples_.emplace(gl::Format::RGBA32UI, glm::ivec2(kSampleRow, rows));
  std::vector<uint32_t> texels(size_t{4} * kSampleRow * size_t(rows), 0U);
  for (size_t i = 0; i < samples.size(); ++i) {
    texels[4 * i] = samples[i].triangle;
    texels[4 * i + 1] = std::bit_cast<uint32_t>(samples[i].u);
    texels[4 * i + 2] = std::bit_cast<uint32_t>(samples[i].v);
    texels[4 * i + 3] = std::bit_cast<uint32_t>(static_cast<float>(samples[i].area / (h * h)));
  }
  samples_->writeUint(texels);
  sums_.emplace(gl::Format::R32UI, glm::ivec2(size), 1, 12 * size.z);
  for (std::optional<gl::Texture>* texture : {&field_, &next_, &gathered_})
    texture->emplace(format, glm::ivec2(size), 1, 3 * size.z);
}

int64_t LightGrid::bytes() const {
  return volume_->bytes() + samples_->bytes() + sums_->bytes() + field_->bytes() + next_->bytes() +
         gathered_->bytes();
}

void LightGrid::start(frame::Frame& frame) {
  {
    const auto scope = frame.passes().open("global_illumination/voxelize");
    voxelizer_->run(frame, *volume_);
  }
  const auto scope = frame.passes().open("global_illumination/inject");
  inject(frame);
}

void LightGrid::inject(frame::Frame& frame) {
  sums_->clearUint(glm::uvec4(0));
  configureSurfaceLight(*inject_, frame, lighting_);
  volume_->configure(*inject_);
  inject_->set("sampleCount", sampleCount_);
  inject_->set("shift", static_cast<float>(settings_.shift));
  samples_->bindTexture(kInjectSamplesUnit);
  sums_->bindImage(kInjectSumsImage, gl::Access::ReadWrite);
  inject_->dispatch(samples_->sizePx());
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);

  volume_->configure(*seed_);
  field_->bindImage(kPropagateOutImage, gl::Access::Write);
  gathered_->bindImage(kPropagateGatheredImage, gl::Access::Write);
  seed_->use();
  overField(volume_->grid());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);

  // Integrals of Y00 and Y10 over a cone of half-angle w: sqrt(pi) (1 - cos w), sqrt(3 pi) / 2 sin^2 w.
  const bool sixth = settings_.cone == LightCone::Sixth;
  const double cosine = sixth ? 2.0 / 3.0 : std::sqrt(0.5);
  const double constant = std::sqrt(std::numbers::pi) * (1.0 - cosine);
  const double linear = std::sqrt(3.0 * std::numbers::pi) / 2.0 * (1.0 - cosine * cosine);
  volume_->configure(*propagate_);
  propagate_->set("coneConstant", static_cast<float>(constant));
  propagate_->set("coneLinear", static_cast<float>(linear));
  propagate_->set("coneSlope", static_cast<float>(linear / constant));
  propagate_->set("fixedAlbedo", glm::vec3(0.5F));
}

void LightGrid::propagate() {
  field_->bindTexture(kPropagateFieldUnit);
  next_->bindImage(kPropagateOutImage, gl::Access::Write);
  gathered_->bindImage(kPropagateGatheredImage, gl::Access::ReadWrite);
  propagate_->use();
  overField(volume_->grid());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  std::swap(field_, next_);
}

glm::dvec3 LightGrid::flux() const {
  const int depth = volume_->grid().resolution.z;
  const double h = volume_->grid().voxelSize;
  glm::dvec3 out(0.0);
  for (int channel = 0; channel < 3; ++channel)
    for (int z = 0; z < depth; ++z) {
      const Image layer = field_->readLayer(channel * depth + z);
      for (size_t i = 0; i < layer.pixels(); ++i) out[channel] += layer.data[4 * i];
    }
  return std::sqrt(4.0 * std::numbers::pi) * h * h * out;
}

}  // namespace limen::techniques
