// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/voxels/sampled_volume.h"

namespace limen::voxels {
namespace {

constexpr int64_t kStateHeader = 2 * int64_t{sizeof(SampleCounts)};

}  // namespace

SampledVolume::SampledVolume(gl::Context& context, const VoxelGrid& grid, glm::dvec3 anchor, bool attributes,
                             int views, int64_t samples)
    : grid_(grid),
      anchor_(anchor),
      occupancy_(context, grid, anchor),
      state_(kStateHeader + 4 * samples, nullptr) {
  const glm::ivec3 size = grid.resolution;
  if (attributes) {
    const auto layers = [&](gl::Format format) { return gl::Texture(format, glm::ivec2(size), 1, size.z); };
    const int64_t words = int64_t{kSampleWords} + int64_t{kSampleViewWords} * views;
    attributes_.emplace(Attributes{layers(gl::Format::RGBA16F), layers(gl::Format::RGBA16F),
                                   layers(gl::Format::RGBA16F),
                                   gl::Texture(gl::Format::R32UI, occupancy_.bits().sizePx(), 1, size.z),
                                   layers(gl::Format::R32UI), gl::Buffer(4 * words * samples, nullptr)});
    attributes_->sums.clearUint(0);
    attributes_->touched.clearUint(glm::uvec4(0));
  }
  state_.clearUint(0);
  clear();
}

int64_t SampledVolume::bytes() const {
  int64_t sum = occupancy_.bytes() + state_.bytes();
  if (attributes_)
    sum += attributes_->normal.bytes() + attributes_->albedo.bytes() + attributes_->light.bytes() +
           attributes_->touched.bytes() + attributes_->slots.bytes() + attributes_->sums.bytes();
  return sum;
}

void SampledVolume::clear() const {
  occupancy_.clear();
  if (!attributes_) return;
  for (const gl::Texture* texture : {&attributes_->normal, &attributes_->albedo, &attributes_->light})
    texture->clear(glm::vec4(0.0F));
}

void SampledVolume::moveTo(glm::dvec3 origin) {
  grid_.origin = origin;
  clear();
}

void SampledVolume::configure(const gl::Program& program) const {
  occupancy_.configure(program);
  program.set("gridOrigin", glm::vec3(grid_.origin - anchor_));
}

void SampledVolume::bind(const gl::Program& program) const {
  configure(program);
  program.set("turn", turn_);
  occupancy_.bits().bindImage(kSampledBitsImage, gl::Access::ReadWrite);
  state_.bindStorage(kSampleStateBuffer);
  if (!attributes_) return;
  attributes_->touched.bindImage(kTouchedBitsImage, gl::Access::ReadWrite);
  attributes_->slots.bindImage(kSlotsImage, gl::Access::ReadWrite);
  attributes_->normal.bindImage(kSampledNormalImage, gl::Access::Write);
  attributes_->albedo.bindImage(kSampledAlbedoImage, gl::Access::Write);
  attributes_->light.bindImage(kSampledLightImage, gl::Access::Write);
}

gl::ShaderDefines SampledVolume::defines() const {
  gl::ShaderDefines defines;
  if (attributes_) defines["ATTRIBUTES"] = "1";
  return defines;
}

}  // namespace limen::voxels
