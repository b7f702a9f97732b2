// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/bitmask/mask_gathering.h"

#include <epoxy/gl.h>

#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/bitmask/bitmask_bindings.h"
#include "renderer/techniques/soft_shadows/bitmask/half_space_table.h"
#include "renderer/techniques/soft_shadows/bitmask/rectangle_table.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char *kTables = "soft_shadows/mask_tables", *kKept = "soft_shadows/kept_masks",
                     *kJoin = "soft_shadows/join_masks";

/// Number and positions of the samples.
gl::ShaderDefines sampleDefines(const SampleChoice& samples) {
  gl::ShaderDefines defines;
  defineSamples(defines, samples.pattern);
  if (!isGridPattern(samples.pattern)) defines["RECTANGLES"] = std::to_string(samples.rectangleTable);
  return defines;
}

}  // namespace

MaskGathering::MaskGathering(const MaskedOccluders& occluders, const SampleChoice& samples, Masks masks)
    : pattern_(samples),
      quads_(quadMaskChoice(occluders)),
      halfSpaceSize_(quads_.mask == QuadMask::HalfSpaceTable ? quads_.tableSize : 0),
      rectangleSize_(isGridPattern(pattern_.pattern) || halfSpaceSize_ > 0 ? 0 : pattern_.rectangleTable),
      stored_(masks),
      maskDefines_(sampleDefines(samples)) {}

gl::ShaderDefines MaskGathering::prepare(frame::Frame& frame, const MapSource& maps) {
  maps_ = &maps;
  samples_ = lightSamples(pattern_.pattern, pattern_.seed);
  const scene::AreaLight& light = frame.scene().lights.at(0);
  if (light.shape != scene::LightShape::Rectangle) {
    const std::vector<uint32_t> mask = lightMask(light, samples_);
    maskDefines_["SHAPED_LIGHT"] = "1";
    maskDefines_["LIGHT_SAMPLES"] = std::to_string(bitCount(mask));
    lightMask_.emplace(mask);
  }
  gl::ShaderDefines defines = maskDefines_;
  defineEnum(defines, "QUAD_MASK", quads_.mask);
  defines["TABLE_SIZE"] = std::to_string(quads_.tableSize);
  sets_ = maps.perObject() ? static_cast<int>(maps.maps().size()) : 1;
  if (stored_ == Masks::Stored || maps.passes() > 1) {
    defines["KEEP_MASKS"] = "1";
    masks_.emplace(frame.sizePx(), samples_.size(), static_cast<size_t>(sets_));
    frame.passes().setBytesHeld(kKept, masks_->bytes());
  }
  if (sets_ > 1 && stored_ == Masks::Joined)
    join_ = &frame.context().programs().compute(
        "renderer/techniques/soft_shadows/bitmask/join_masks.comp.glsl", maskDefines_);
  if (halfSpaceSize_ > 0) halfSpaces_.emplace(makeHalfSpaceTable(samples_, halfSpaceSize_));
  if (rectangleSize_ > 0) rectangles_.emplace(makeRectangleTable(samples_, rectangleSize_));
  const int64_t bytes = (halfSpaces_ ? halfSpaces_->bytes() : 0) + (rectangles_ ? rectangles_->bytes() : 0);
  if (bytes > 0) frame.passes().setBytesHeld(kTables, bytes);
  return defines;
}

int MaskGathering::bindMasks() const {
  masks_->bind();
  if (lightMask_) lightMask_->bindStorage(kLightMaskBuffer);
  return sets_;
}

void MaskGathering::configure(const gl::Program& program, size_t map) const {
  if (halfSpaces_) halfSpaces_->bindTexture(kHalfSpacesUnit);
  if (rectangles_) rectangles_->bindTexture(kRectangleMasksUnit);
  if (lightMask_) lightMask_->bindStorage(kLightMaskBuffer);
  if (!masks_) return;
  masks_->bind();
  const int number = static_cast<int>(map);
  program.set("keptSet", maps_->perObject() ? number : 0);
  program.set("joins", !maps_->perObject() && number > 0 ? 1 : 0);
}

void MaskGathering::join(frame::Frame& frame, const gl::Texture& visibility) {
  if (!join_) return;
  const gl::Texture& receivers = frame.get<frame::Receivers>().texture();
  const auto scope = frame.passes().open(kJoin);
  join_->set("sizePx", frame.sizePx());
  join_->set("sets", bindMasks());
  receivers.bindTexture(kJoinMasksReceiversUnit);
  visibility.bindImage(kJoinMasksVisibilityImage, gl::Access::Write);
  join_->dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

int MaskGathering::mapsWithCasters(frame::Frame& frame) const {
  int count = 0;
  for (const frame::ShadowMapSettings& map : maps_->maps()) {
    const auto& pyramid = frame.get<frame::MinMaxPyramid>(map);
    count += pyramid.minimum().read(pyramid.levels() - 1).at(0, 0) < frame::kEmptyDepth;
  }
  return count;
}

std::vector<Counter> MaskGathering::count(frame::Frame& frame) const {
  return {{"maps_read", double(maps_->mapsAtRest())},
          {"maps_with_casters", double(mapsWithCasters(frame))},
          {"mask_bytes", masks_ ? double(masks_->bytes()) : 0.0}};
}

std::vector<Quantity> MaskGathering::quantities() {
  return {{"maps_read", "Shadow maps read", "", Direction::LowerIsBetter},
          {"maps_with_casters", "Shadow maps with casters", "", Direction::Neither},
          {"mask_bytes", "Memory of stored masks", "byte", Direction::LowerIsBetter}};
}

}  // namespace limen::techniques
