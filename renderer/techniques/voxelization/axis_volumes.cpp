// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/voxelization/axis_volumes.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "renderer/techniques/voxelization/voxelization_bindings.h"
#include "renderer/voxels/voxel_bindings.h"

namespace limen::techniques {
namespace {

using voxels::VoxelAttribute;

std::vector<VoxelAttribute> attributesOf(const voxels::Volume& volume) {
  std::vector<VoxelAttribute> out;
  for (const auto& entry : enumNames(VoxelAttribute{}).entries)
    if (volume.attributes().has(entry.value)) out.push_back(entry.value);
  return out;
}

bool keepsMaximum(VoxelAttribute attribute, FragmentBlend blend) {
  return blend == FragmentBlend::Maximum || attribute <= VoxelAttribute::Albedo;
}

const char* mergeDefine(VoxelAttribute attribute, FragmentBlend blend) {
  const bool lobe = attribute >= VoxelAttribute::ShGrey;
  if (!keepsMaximum(attribute, blend)) return lobe ? "MEAN_NORMAL" : "MEAN_ALPHA";
  return lobe ? "SIGNED" : attribute == VoxelAttribute::Normal ? "SIGNED_XYZ" : "UNSIGNED";
}

std::string outputDefine(VoxelAttribute attribute) {
  std::string out = std::string("OUT_") + limen::toText(attribute);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::toupper(c); });
  return out;
}

}  // namespace

AxisVolumes::AxisVolumes(frame::Frame& frame, const voxels::Volume& volume, Form form)
    : form_(std::move(form)),
      attributes_(attributesOf(volume)),
      merge_(frame.context().programs().compute("renderer/techniques/voxelization/merge_axes.comp.glsl",
                                                volume.sumDefines())) {
  gl::ShaderDefines defines = form_.defines;
  defines.merge(volume.defines());
  defines.merge(volume.sumDefines());
  defines.merge(voxels::surfaceDefines(frame, volume.attributes(), form_.lamps));
  if (form_.blend == FragmentBlend::Maximum) defines["BLEND_MAXIMUM"] = "1";
  for (size_t i = 0; i < attributes_.size(); ++i) defines[outputDefine(attributes_[i])] = std::to_string(i);
  const glm::ivec3 size = volume.grid().resolution;
  for (int axis = 0; axis < 3; ++axis) {
    gl::ShaderDefines own = defines;
    own["AXIS"] = std::to_string(axis);
    Axis made{.program = &frame.context().programs().get(form_.stages, own),
              .layers = {},
              .targets = {},
              .slices = {}};
    const glm::ivec2 across{size[(axis + 1) % 3], size[(axis + 2) % 3]};
    for (size_t i = 0; i < std::max<size_t>(attributes_.size(), 1); ++i) {
      made.layers.emplace_back(attributes_.empty() ? gl::Format::R8 : volume.attributes().format, across, 1,
                               size[axis]);
      made.layers.back().clear(glm::vec4(0.0F));
    }
    for (int slice = 0; slice < (form_.passPerSlice ? size[axis] : 1); ++slice) {
      std::vector<const gl::Texture*> targets;
      const size_t first = made.slices.size();
      if (form_.passPerSlice)
        for (const gl::Texture& layers : made.layers) made.slices.push_back(layers.view(slice));
      for (size_t i = 0; i < made.layers.size(); ++i)
        targets.push_back(form_.passPerSlice ? &made.slices[first + i] : &made.layers[i]);
      made.targets.emplace_back(targets, nullptr);
    }
    axes_.push_back(std::move(made));
  }
  for (const VoxelAttribute attribute : attributes_) {
    gl::ShaderDefines own = volume.sumDefines();
    own[mergeDefine(attribute, form_.blend)] = "1";
    mergeAttachment_.push_back(&frame.context().programs().compute(
        "renderer/techniques/voxelization/merge_attachment.comp.glsl", own));
  }
}

void AxisVolumes::setBlending(const voxels::Volume& volume) const {
  if (!volume.attributes().any()) return;
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  for (size_t i = 0; i < attributes_.size(); ++i)
    glBlendEquationi(static_cast<GLuint>(i),
                     keepsMaximum(attributes_[i], form_.blend) ? GL_MAX : GL_FUNC_ADD);
}

void AxisVolumes::draw(frame::Frame& frame, const voxels::Volume& volume, const Axis& axis) const {
  constexpr std::array<float, 4> kEmpty = {0.0F, 0.0F, 0.0F, 0.0F};
  volume.configure(*axis.program);
  if (form_.defines.count("CONSERVATIVE") != 0) frame.gpuScene().bindStorage(&frame.positions());
  if (volume.attributes().any()) {
    frame.bindSurfaces();
    frame.gpuScene().bindStorage(&frame.positions());
    voxels::configureSurfaces(*axis.program, frame, volume.attributes(), form_.lamps);
  }
  axis.program->use();
  for (size_t slice = 0; slice < axis.targets.size(); ++slice) {
    axis.targets[slice].bind();
    for (size_t i = 0; i < axis.layers.size(); ++i)
      glClearBufferfv(GL_COLOR, static_cast<GLint>(i), kEmpty.data());
    if (form_.passPerSlice) axis.program->set("slice", static_cast<int>(slice));
    frame.geometry().draw();
  }
}

void AxisVolumes::fill(frame::Frame& frame, const voxels::Volume& volume) {
  if (volume.attributes().any()) volume.clear();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  setBlending(volume);
  const bool all = form_.refresh == AxisRefresh::All || frame_ == 0;
  for (int axis = 0; axis < 3; ++axis)
    if (all || axis == frame_ % 3) draw(frame, volume, axes_[static_cast<size_t>(axis)]);
  ++frame_;
  glDisable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  merge(volume);
}

void AxisVolumes::bindLayers(size_t attachment, uint32_t firstUnit) const {
  for (uint32_t axis = 0; axis < 3; ++axis) axes_[axis].layers[attachment].bindTexture(firstUnit + axis);
}

void AxisVolumes::merge(const voxels::Volume& volume) const {
  bindLayers(0, kAxisVolumeXUnit);
  volume.bits().bindImage(kMergedBitsImage, gl::Access::Write);
  volume.configure(merge_);
  merge_.use();
  const glm::ivec3 words(volume.bits().sizePx(), volume.grid().resolution.z);
  glDispatchCompute(static_cast<GLuint>(words.x), static_cast<GLuint>((words.y + 63) / 64),
                    static_cast<GLuint>(words.z));
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  const auto normal = std::find(attributes_.begin(), attributes_.end(), VoxelAttribute::Normal);
  for (size_t i = 0; i < attributes_.size(); ++i) {
    bindLayers(i, kAxisVolumeXUnit);
    if (normal != attributes_.end())
      bindLayers(static_cast<size_t>(normal - attributes_.begin()), kAxisNormalXUnit);
    volume.attachment(attributes_[i]).bindImage(kMergedAttachmentImage, gl::Access::Write);
    mergeAttachment_[i]->set("largest", attributes_[i] == VoxelAttribute::Normal
                                            ? 1.0F
                                            : 1.0234F * volume.attributes().largestLight);
    volume.dispatchWords(*mergeAttachment_[i]);
  }
}

int64_t AxisVolumes::bytes() const {
  int64_t sum = 0;
  for (const Axis& axis : axes_)
    for (const gl::Texture& layers : axis.layers) sum += layers.bytes();
  return sum;
}

int64_t AxisVolumes::draws() const {
  size_t sum = 0;
  for (const Axis& axis : axes_) sum += axis.targets.size();
  return static_cast<int64_t>(form_.refresh == AxisRefresh::One ? sum / 3 : sum);
}

}  // namespace limen::techniques
