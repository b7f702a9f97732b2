// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/incremental_voxels/sampled_volume.h"

#include <algorithm>
#include <bit>

#include "renderer/incremental_voxels/clean_up.h"

namespace limen::incremental_voxels {
namespace {

constexpr int64_t kStateHeader = 2 * int64_t{sizeof(SampleCounts)};

/// Twice as many as voxels with samples may be, so that few look for theirs for long.
uint32_t placesFor(bool attributes, const voxels::VoxelGrid& grid, int64_t samples) {
  if (!attributes) return 1;
  return static_cast<uint32_t>(
      std::bit_ceil(static_cast<uint64_t>(2 * std::max<int64_t>(std::min(samples, grid.count()), 1))));
}

}  // namespace

SampledVolume::SampledVolume(gl::Context& context, const voxels::VoxelGrid& grid, glm::dvec3 anchor,
                             bool attributes, int views, int64_t samples, bool scrolls)
    : grid_(grid),
      anchor_(anchor),
      occupancy_(context, grid, anchor),
      scrolls_(scrolls),
      places_(placesFor(attributes, grid, samples)),
      state_(kStateHeader + 4 * int64_t{places_}, nullptr) {
  const glm::ivec3 size = grid.resolution;
  if (attributes) {
    const auto layers = [&](gl::Format format) { return gl::Texture(format, glm::ivec2(size), 1, size.z); };
    const int64_t words = int64_t{kSampleWords} + int64_t{kSampleViewWords} * views;
    attributes_.emplace(Attributes{layers(gl::Format::RGBA16F), layers(gl::Format::RGBA16F),
                                   layers(gl::Format::RGBA16F), gl::Buffer(4 * words * places_, nullptr)});
    attributes_->sums.clearUint(0);
    for (const gl::Texture* texture : {&attributes_->normal, &attributes_->albedo, &attributes_->light})
      texture->clear(glm::vec4(0.0F));
  }
  state_.clearUint(0);
  gl::ShaderDefines defines = this->defines();
  defines["FORGET"] = "1";
  forget_ = &context.programs().compute("renderer/incremental_voxels/clean_up.comp.glsl", defines);
}

int64_t SampledVolume::bytes() const {
  int64_t sum = occupancy_.bytes() + state_.bytes();
  if (attributes_)
    sum += attributes_->normal.bytes() + attributes_->albedo.bytes() + attributes_->light.bytes() +
           attributes_->sums.bytes();
  return sum;
}

void SampledVolume::clear() const { forgetEntered(grid_.resolution); }

glm::ivec3 SampledVolume::moveTo(glm::dvec3 origin) {
  const glm::ivec3 size = grid_.resolution;
  const glm::dvec3 voxels = glm::round((origin - grid_.origin) / grid_.voxelSize);
  grid_.origin = origin;
  glm::ivec3 shift = size;
  if (scrolls_) {
    // Nothing stays of a grid that moves by its own size.
    shift = glm::ivec3(glm::clamp(voxels, -glm::dvec3(size), glm::dvec3(size)));
    wrap_ = ((wrap_ + shift) % size + size) % size;
  }
  forgetEntered(shift);
  return shift;
}

void SampledVolume::forgetEntered(glm::ivec3 shift) const {
  bind(*forget_);
  forget_->set("shiftX", shift.x);
  forget_->set("shiftY", shift.y);
  forget_->set("shiftZ", shift.z);
  const glm::ivec3 counts = brickCounts(grid_);
  dispatchBricks(*forget_, grid_, counts.x * counts.y * counts.z);
}

std::vector<uint8_t> SampledVolume::readOccupied() const {
  const std::vector<uint8_t> stored = occupancy_.readOccupied();
  std::vector<uint8_t> out(stored.size());
  glm::ivec3 v;
  for (v.z = 0; v.z < grid_.resolution.z; ++v.z)
    for (v.y = 0; v.y < grid_.resolution.y; ++v.y)
      for (v.x = 0; v.x < grid_.resolution.x; ++v.x)
        out[static_cast<size_t>(grid_.indexOf(v))] =
            stored[static_cast<size_t>(grid_.indexOf(storedVoxel(v)))];
  return out;
}

void SampledVolume::configure(const gl::Program& program) const {
  occupancy_.configure(program);
  program.set("gridOrigin", glm::vec3(grid_.origin - anchor_));
  if (!scrolls_) return;
  program.set("wrapX", wrap_.x);
  program.set("wrapY", wrap_.y);
  program.set("wrapZ", wrap_.z);
}

void SampledVolume::bind(const gl::Program& program) const {
  configure(program);
  program.set("turn", turn_);
  occupancy_.bits().bindImage(kSampledBitsImage, gl::Access::ReadWrite);
  state_.bindStorage(kSampleStateBuffer);
  if (!attributes_) return;
  attributes_->normal.bindImage(kSampledNormalImage, gl::Access::Write);
  attributes_->albedo.bindImage(kSampledAlbedoImage, gl::Access::Write);
  attributes_->light.bindImage(kSampledLightImage, gl::Access::Write);
}

gl::ShaderDefines SampledVolume::defines() const {
  gl::ShaderDefines defines;
  if (attributes_) defines["ATTRIBUTES"] = "1";
  if (scrolls_) defines["TOROIDAL"] = "1";
  return defines;
}

}  // namespace limen::incremental_voxels
