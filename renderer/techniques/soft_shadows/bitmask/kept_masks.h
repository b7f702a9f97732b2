// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>

#include "renderer/gl/texture.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

namespace limen::techniques {

/// Masks of all pixels, in sets: RGBA32UI layers of 128 samples, all layers of one set after another. Shaders
/// include kept_masks.glsl.
class KeptMasks {
 public:
  KeptMasks(glm::ivec2 sizePx, size_t samples, size_t sets)
      : image_(gl::Format::RGBA32UI, sizePx, 1, static_cast<int>((samples + 127) / 128 * sets)) {}
  void bind() const { image_.bindImage(kKeptMasksImage, gl::Access::ReadWrite); }
  int64_t bytes() const { return image_.bytes(); }
  const gl::Texture& image() const { return image_; }

 private:
  gl::Texture image_;
};

}  // namespace limen::techniques
