// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/gl/texture.h"

namespace limen::gl {

/// Immutable 3D texture with levels, read with filtering within and between these; clamped to the edge.
class VolumeTexture {
 public:
  /// Throws Error if the device cannot hold it.
  VolumeTexture(Format format, glm::ivec3 size, int levels);
  /// Four channels from -1 to 1, of 16 bits each; one level. Only to be read.
  static VolumeTexture ofSignedShares(glm::ivec3 size);
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
  /// The finest level of a float format, from four floats a texel.
  void write(const std::vector<float>& texels) const;

 private:
  VolumeTexture(uint32_t internal, int texelBytes, glm::ivec3 size, int levels);

  uint32_t id_ = 0, internal_;
  int texelBytes_;
  glm::ivec3 size_;
  int levels_;
};

}  // namespace limen::gl
