// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/frame/shaded.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace limen::techniques {

/// Picture of a scene with mirrors (Roger 2008, section 1.2.2, Whitted's model): what Shaded makes of every
/// pixel, plus, where a pixel sees a mirror, the mirror's share of the radiance that a technique found along
/// the mirrored ray. All techniques of the family end here, so that their pictures differ by what they
/// reflect alone.
class ReflectionPicture {
 public:
  /// `refraction`: as MirrorRays has it.
  explicit ReflectionPicture(const frame::ShadedSetting& shading, bool refraction = false)
      : shading_(shading), refraction_(refraction) {}

  void prepare(frame::Frame& frame);
  /// `reflected`: RGBA32F of the frame's size, radiance at pixels with a ray in MirrorRays; alpha: the share
  /// of the ray's light that it accounts for, 0..1; for the rest the background is taken.
  void compose(frame::Frame& frame, const gl::Texture& reflected);
  /// RGBA32F, linear radiance, alpha 1.
  const gl::Texture& texture() const { return *picture_; }

  const frame::ShadedSetting& shading() const { return shading_; }

 private:
  frame::ShadedSetting shading_;
  bool refraction_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> picture_;
};

}  // namespace limen::techniques
