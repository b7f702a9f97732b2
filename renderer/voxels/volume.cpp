// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/voxels/volume.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "experiments/base/error.h"
#include "renderer/voxels/voxel_bindings.h"

namespace limen::voxels {
namespace {

struct AttachmentPlace {
  const char* define;
  const char* sum;
  uint32_t unit, image;
};
/// In the order of VoxelAttribute.
constexpr AttachmentPlace kPlaces[kVoxelAttributes] = {
    {"VOLUME_OCCUPANCY", nullptr, kVolumeOccupancyUnit, kVolumeOccupancyImage},
    {"VOLUME_ALBEDO", "SUM_ALBEDO", kVolumeAlbedoUnit, kVolumeAlbedoImage},
    {"VOLUME_NORMAL", "SUM_NORMAL", kVolumeNormalUnit, kVolumeNormalImage},
    {"VOLUME_LIGHT", "SUM_LIGHT", kVolumeLightUnit, kVolumeLightImage},
    {"VOLUME_SH_GREY", "SUM_SH_GREY", kVolumeShGreyUnit, kVolumeShGreyImage},
    {"VOLUME_SH_RED", "SUM_SH_RED", kVolumeShRedUnit, kVolumeShRedImage},
    {"VOLUME_SH_GREEN", "SUM_SH_GREEN", kVolumeShGreenUnit, kVolumeShGreenImage},
    {"VOLUME_SH_BLUE", "SUM_SH_BLUE", kVolumeShBlueUnit, kVolumeShBlueImage}};

/// Voxels with sums.
int64_t slotsOf(const VoxelGrid& grid, const VolumeAttributes& attributes) {
  if (!attributes.any() || !attributes.summed) return 0;
  return attributes.sumsOccupied() && attributes.mostOccupied > 0
             ? std::min(attributes.mostOccupied, grid.count())
             : grid.count();
}

int64_t sumBytesOf(const VoxelGrid& grid, const VolumeAttributes& attributes) {
  return slotsOf(grid, attributes) * SumLayout(attributes).words * 4;
}

int64_t bytesOf(const VoxelGrid& grid, const VolumeAttributes& attributes) {
  const int64_t bits = int64_t{(grid.resolution.x + 31) / 32} * grid.resolution.y * grid.resolution.z * 4;
  const int64_t attachments = attributes.joined ? 0 : grid.count() * attributes.bitsPerVoxel() / 8;
  return (attributes.sumsOccupied() ? 2 : 1) * bits + sumBytesOf(grid, attributes) + attachments;
}

std::string mebibytes(int64_t bytes) { return std::to_string((bytes + (1 << 20) - 1) >> 20) + " MiB"; }

int64_t mostBufferBytes() {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  return most;
}

/// The attributes in a format within their budget.
VolumeAttributes fitting(const VoxelGrid& grid, VolumeAttributes attributes) {
  assert(attributes.format == gl::Format::RGBA16F || attributes.format == gl::Format::RGBA32F);
  if (bytesOf(grid, attributes) > attributes.budgetBytes && attributes.mayHalve)
    attributes.format = gl::Format::RGBA16F;
  const int64_t bytes = bytesOf(grid, attributes);
  const std::string what = "a volume of " + std::to_string(grid.resolution.x) + " x " +
                           std::to_string(grid.resolution.y) + " x " + std::to_string(grid.resolution.z) +
                           " voxels with " + std::to_string(attributes.count()) + " attributes";
  if (bytes > attributes.budgetBytes)
    throw Error(what + " takes " + mebibytes(bytes) + ", more than its budget of " +
                    mebibytes(attributes.budgetBytes),
                {}, "choose a lower resolution, fewer attributes or 16-bit floats, or raise the budget");
  const int64_t most = mostBufferBytes();
  const int64_t sums = sumBytesOf(grid, attributes);
  if (sums > most)
    throw Error(what + " needs sums of " + mebibytes(sums) + "; this device's shaders reach " +
                    mebibytes(most) + " of a buffer",
                {}, "choose a lower resolution, fewer attributes or sums of occupied voxels");
  return attributes;
}

}  // namespace

Volume::Volume(gl::Context& context, const VoxelGrid& grid, glm::dvec3 anchor,
               const VolumeAttributes& attributes)
    : grid_(grid),
      anchor_(anchor),
      attributes_(fitting(grid, attributes)),
      bits_(gl::Format::R32UI, {(grid.resolution.x + 31) / 32, grid.resolution.y}, 1, grid.resolution.z),
      empty_(&context.programs().compute("renderer/voxels/empty_bits.comp.glsl")),
      unite_(&context.programs().compute("renderer/voxels/empty_bits.comp.glsl", {{"UNITE", "1"}})) {
  const glm::ivec3 size = grid.resolution;
  for (const auto& [attribute, name] : enumNames(VoxelAttribute{}).entries) {
    if (!attributes_.has(attribute) || attributes_.joined) continue;
    auto& attachment = attachments_[static_cast<size_t>(attribute)];
    attachment.emplace(attributes_.format, glm::ivec2(size), 1, size.z);
    attachment->clear(glm::vec4(0.0F));
  }
  bits_.clearUint(glm::uvec4(0));
  if (!attributes_.any()) return;
  gl::ShaderDefines own = defines();
  own.merge(sumDefines());
  assert(attributes_.summed || !attributes_.joined);
  const auto program = [&](const char* define) {
    gl::ShaderDefines with = own;
    if (define) with[define] = "1";
    return &context.programs().compute("renderer/voxels/finish_volume.comp.glsl", with);
  };
  erase_ = program("ERASE");
  if (!attributes_.summed) return;
  sums_.emplace(sumBytesOf(grid_, attributes_), nullptr);
  sums_->clearUint(0);
  if (attributes_.sumsOccupied()) {
    empty_ = &context.programs().compute("renderer/voxels/empty_bits.comp.glsl", {{"NUMBERED", "1"}});
    number_ = &context.programs().compute("renderer/voxels/number_occupied.comp.glsl");
    slots_.emplace(gl::Format::R32UI, bits_.sizePx(), 1, size.z);
    slots_->clearUint(glm::uvec4(0));
    occupied_.emplace(int64_t{16}, nullptr);
    occupied_->clearUint(0);
  }
  if (attributes_.joined) return;
  finish_ = program(nullptr);
  finishWith_ = program("BASE");
}

bool fitSumsOfAll(const VoxelGrid& grid, VolumeAttributes attributes) {
  attributes.sums = VoxelSums::All;
  return sumBytesOf(grid, attributes) <= mostBufferBytes() &&
         bytesOf(grid, attributes) <= attributes.budgetBytes;
}

int64_t Volume::bytes() const { return bytesOf(grid_, attributes_); }

void Volume::bindAttachments() const {
  for (size_t i = 0; i < kVoxelAttributes; ++i)
    if (attachments_[i]) attachments_[i]->bindImage(kPlaces[i].image, gl::Access::Write);
}

void Volume::dispatchWords(const gl::Program& program) const {
  configure(program);
  program.use();
  const int64_t words = int64_t{bits_.sizePx().x} * bits_.sizePx().y * grid_.resolution.z;
  const auto groups = static_cast<GLuint>((words + kVolumeWords - 1) / kVolumeWords);
  const GLuint rows = (groups + 65534) / 65535;
  glDispatchCompute((groups + rows - 1) / rows, rows, 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_SHADER_STORAGE_BARRIER_BIT);
}

void Volume::clear() const {
  if (attributes_.joined) {
    sums_->clearUint(0);
  } else if (erase_) {
    bindAttachments();
    dispatchWords(*erase_);
  }
  if (occupied_) occupied_->bindStorage(kVolumeOccupiedBuffer);
  bits_.bindImage(kVolumeEmptyBitsImage, gl::Access::Write);
  dispatchWords(*empty_);
}

void Volume::unite(const Volume& other) const {
  assert(other.grid_.resolution == grid_.resolution);
  other.bits_.bindTexture(kVolumeBaseBitsUnit);
  bits_.bindImage(kVolumeEmptyBitsImage, gl::Access::Write);
  dispatchWords(*unite_);
}

void Volume::numberOccupied() const {
  if (!number_) return;
  slots_->bindImage(kVolumeSlotsImage, gl::Access::Write);
  occupied_->bindStorage(kVolumeOccupiedBuffer);
  dispatchWords(*number_);
}

void Volume::finish(const Volume* base) const {
  if (!finish_) return;
  const gl::Program& program = base ? *finishWith_ : *finish_;
  sums_->bindStorage(kVoxelSumsBuffer);
  if (base) {
    assert(base->attributes_.count() == attributes_.count() && base->attributes_.sums == attributes_.sums);
    base->sums_->bindStorage(kVolumeBaseSumsBuffer);
    if (base->slots_) {
      base->bits_.bindTexture(kVolumeBaseBitsUnit);
      base->slots_->bindTexture(kVolumeBaseSlotsUnit);
      program.set("baseCapacity", static_cast<uint32_t>(slotsOf(base->grid_, base->attributes_)));
    }
  }
  bindAttachments();
  configureSums(program);
  dispatchWords(program);
}

int64_t Volume::withoutSums() const {
  if (!occupied_) return 0;
  return std::max<int64_t>(occupied_->read<uint32_t>(0, 1)[0] - slotsOf(grid_, attributes_), 0);
}

double Volume::sumSteps() const {
  const double most = 2147483647.0 / static_cast<double>(std::max<int64_t>(attributes_.mostEntries, 1));
  return std::min(std::exp2(std::floor(std::log2(most))), 1048576.0);
}

// A lobe's largest coefficient is sqrt(pi / 3) = 1.0233 times its radiance.
double Volume::lightSteps() const { return sumSteps() / (1.0234 * attributes_.largestLight); }

gl::ShaderDefines Volume::defines() const {
  gl::ShaderDefines defines;
  for (const auto& entry : enumNames(VoxelAttribute{}).entries)
    if (attributes_.has(entry.value)) defines[kPlaces[static_cast<size_t>(entry.value)].define] = "1";
  return defines;
}

gl::ShaderDefines Volume::sumDefines() const {
  gl::ShaderDefines defines;
  if (!attributes_.any()) return defines;
  const SumLayout layout(attributes_);
  defines["SUMS"] = std::to_string(layout.words) + "u";
  if (layout.opacity >= 0) defines["SUM_OPACITY"] = std::to_string(layout.opacity) + "u";
  for (size_t i = 0; i < kVoxelAttributes; ++i)
    if (layout.first[i] >= 0) defines[kPlaces[i].sum] = std::to_string(layout.first[i]) + "u";
  if (attributes_.sumsOccupied()) defines["OCCUPIED_SUMS"] = "1";
  defines["VOLUME_FORMAT"] = attributes_.format == gl::Format::RGBA32F ? "rgba32f" : "rgba16f";
  return defines;
}

void Volume::configureSums(const gl::Program& program) const {
  program.set("sumSteps", static_cast<float>(sumSteps()));
  program.set("lightSteps", static_cast<float>(lightSteps()));
  if (!slots_) return;
  slots_->bindTexture(kVolumeSlotsUnit);
  program.set("slotCapacity", static_cast<uint32_t>(slotsOf(grid_, attributes_)));
}

void Volume::configure(const gl::Program& program) const {
  bits_.bindTexture(kVolumeBitsUnit);
  for (size_t i = 0; i < kVoxelAttributes; ++i)
    if (attachments_[i]) attachments_[i]->bindTexture(kPlaces[i].unit);
  program.set("gridOrigin", glm::vec3(grid_.origin - anchor_));
  program.set("voxelSize", static_cast<float>(grid_.voxelSize));
  program.set("gridSizeX", grid_.resolution.x);
  program.set("gridSizeY", grid_.resolution.y);
  program.set("gridSizeZ", grid_.resolution.z);
}

std::vector<uint8_t> Volume::readOccupied() const {
  std::vector<uint8_t> out(static_cast<size_t>(grid_.count()));
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  const glm::ivec3 size = grid_.resolution;
  const int wide = bits_.sizePx().x;
  for (int z = 0; z < size.z; ++z) {
    const std::vector<uint32_t> words = bits_.readUintLayer(z);
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x)
        out[static_cast<size_t>(grid_.indexOf({x, y, z}))] =
            words[static_cast<size_t>(y) * wide + x / 32] >> (x % 32) & 1U;
  }
  return out;
}

void Volume::writeOccupied(const std::vector<uint8_t>& occupied) const {
  const glm::ivec3 size = grid_.resolution;
  const int wide = bits_.sizePx().x;
  for (int z = 0; z < size.z; ++z) {
    std::vector<uint32_t> words(static_cast<size_t>(wide) * size.y);
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x)
        if (occupied[static_cast<size_t>(grid_.indexOf({x, y, z}))])
          words[static_cast<size_t>(y) * wide + x / 32] |= 1U << (x % 32);
    bits_.writeUint(words, z);
  }
}

}  // namespace limen::voxels
