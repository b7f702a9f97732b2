// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

#include "experiments/base/image.h"

namespace limen::gl {

enum class Format {
  R8,
  R16F,
  R32F,
  RG16F,
  RG32F,
  RGBA8,
  RGBA16F,
  RGBA32F,
  R8UI,
  R32UI,
  RG32UI,
  RGBA16UI,
  RGBA32UI,
  Depth32F
};

int bytesPerTexel(Format format);
int channelCount(Format format);
uint32_t internalFormat(Format format);  ///< GL enumerant

enum class Sampling { Nearest, Linear };  ///< always clamped to the edge
enum class Access { Read, Write, ReadWrite };

/// Immutable 2D texture or, with layers > 0, 2D array.
class Texture {
 public:
  /// Throws Error if the device cannot hold it.
  Texture(Format format, glm::ivec2 sizePx, int levels = 1, int layers = 0,
          Sampling sampling = Sampling::Nearest);
  ~Texture();
  /// Layers of this array as a texture of their own in the same memory: an array of `count`, or a plain
  /// texture if that is 0. It may outlive this one.
  Texture view(int firstLayer, int count = 0) const;
  Texture(Texture&& other) noexcept;
  Texture& operator=(Texture&& other) noexcept;
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  uint32_t id() const { return id_; }
  Format format() const { return format_; }
  glm::ivec2 sizePx() const { return sizePx_; }
  int levels() const { return levels_; }
  int64_t bytes() const;  ///< of all levels and layers

  void bindTexture(uint32_t unit) const;
  /// At most 8 image units are guaranteed.
  void bindImage(uint32_t unit, Access access, int level = 0) const;
  /// All layers. Neither a scissor nor masks of colours may be set.
  void clear(glm::vec4 value, int level = 0) const;
  void clearUint(glm::uvec4 value, int level = 0) const;

  /// Waits for the GPU. Float formats only; row 0 is the top.
  Image read(int level = 0) const;
  /// One layer of an array.
  Image readLayer(int layer, int level = 0) const;
  std::vector<uint32_t> readUint(int level = 0) const;
  /// One layer of an array of an unsigned format.
  std::vector<uint32_t> readUintLayer(int layer, int level = 0) const;
  void write(const Image& image, int level = 0) const;
  /// Unsigned formats only: all channels of the finest level of one layer (0 where there are none).
  void writeUint(const std::vector<uint32_t>& texels, int layer = 0) const;

 private:
  Texture(uint32_t id, const Texture& of, int layers);
  void setSampling();
  uint32_t clearTarget(int level) const;

  uint32_t id_ = 0;
  mutable uint32_t clearTarget_ = 0;
  Format format_;
  glm::ivec2 sizePx_;
  int levels_, layers_;
  Sampling sampling_;
};

/// Render target: colour textures and a depth texture, all of one size, not owned.
class Framebuffer {
 public:
  /// Throws std::runtime_error if the driver reports the combination as incomplete.
  Framebuffer(const std::vector<const Texture*>& colours, const Texture* depth);
  ~Framebuffer();
  Framebuffer(Framebuffer&& other) noexcept : id_(std::exchange(other.id_, 0)), sizePx_(other.sizePx_) {}
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;
  uint32_t id() const { return id_; }
  /// Binds it and sets the viewport.
  void bind() const;

 private:
  uint32_t id_ = 0;
  glm::ivec2 sizePx_{0};
};

}  // namespace limen::gl
