// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderer/gl/texture.h"

namespace limen::gl {

/// Immutable 3D texture with levels, read with filtering within and between these; clamped to the edge.
class VolumeTexture {
 public:
  /// Throws Error if the device cannot hold it.
  VolumeTexture(Format format, glm::ivec3 size, int levels);
  ~VolumeTexture();
  VolumeTexture(VolumeTexture&& other) noexcept;
  VolumeTexture& operator=(VolumeTexture&&) = delete;
  VolumeTexture(const VolumeTexture&) = delete;
  VolumeTexture& operator=(const VolumeTexture&) = delete;

  glm::ivec3 size(int level = 0) const { return glm::max(size_ >> level, glm::ivec3(1)); }
  int levels() const { return levels_; }
  int64_t bytes() const;  ///< of all levels
  void bindTexture(uint32_t unit) const;
  void bindImage(uint32_t unit, Access access, int level = 0) const;
  void clear(glm::vec4 value) const;  ///< all levels

 private:
  uint32_t id_ = 0;
  Format format_;
  glm::ivec3 size_;
  int levels_;
};

}  // namespace limen::gl
