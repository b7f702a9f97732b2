// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>

#include "renderer/techniques/reflections/vertex_reflection/star_map.h"

namespace limen::techniques {

/// A star-shaped reflector's map as a texture: a cube map, or a square of angles that goes round.
class ReflectorTexture {
 public:
  ReflectorTexture(const reflections::StarMap& map, bool halfFloats, bool filter);
  ~ReflectorTexture();
  ReflectorTexture(ReflectorTexture&& other) noexcept
      : id_(std::exchange(other.id_, 0)),
        presentId_(std::exchange(other.presentId_, 0)),
        bytes_(other.bytes_) {}
  ReflectorTexture(const ReflectorTexture&) = delete;
  ReflectorTexture& operator=(const ReflectorTexture&) = delete;
  /// The map, and (R8, 1: the surface is there) where it was not filled.
  void bindTextures(uint32_t unit, uint32_t presentUnit) const;
  int64_t bytes() const { return bytes_; }

 private:
  uint32_t id_ = 0, presentId_ = 0;
  int64_t bytes_ = 0;
};

}  // namespace limen::techniques
