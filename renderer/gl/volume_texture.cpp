// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/volume_texture.h"

#include <epoxy/gl.h>

#include <cassert>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <string>
#include <utility>

#include "experiments/base/error.h"

namespace limen::gl {

VolumeTexture::VolumeTexture(Format format, glm::ivec3 size, int levels)
    : VolumeTexture(internalFormat(format), bytesPerTexel(format), size, levels) {}

VolumeTexture VolumeTexture::ofSignedShares(glm::ivec3 size) { return {GL_RGBA16_SNORM, 8, size, 1}; }

VolumeTexture::VolumeTexture(uint32_t internal, int texelBytes, glm::ivec3 size, int levels)
    : internal_(internal), texelBytes_(texelBytes), size_(size), levels_(levels) {
  assert(size.x > 0 && size.y > 0 && size.z > 0 && levels > 0);
  glCreateTextures(GL_TEXTURE_3D, 1, &id_);
  glTextureStorage3D(id_, levels, internal_, size.x, size.y, size.z);
  const GLenum error = glGetError();
  if (error == GL_OUT_OF_MEMORY || error == GL_INVALID_VALUE) {
    glDeleteTextures(1, &id_);
    throw Error("the device cannot hold a volume of " + std::to_string(size.x) + " x " +
                    std::to_string(size.y) + " x " + std::to_string(size.z) + " texels (" +
                    std::to_string(bytes() >> 20) + " MiB)",
                {}, "choose a smaller size");
  }
  glTextureParameteri(id_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(id_, GL_TEXTURE_MIN_FILTER, levels == 1 ? GL_LINEAR : GL_LINEAR_MIPMAP_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTextureParameteri(id_, wrap, GL_CLAMP_TO_EDGE);
}

VolumeTexture::~VolumeTexture() {
  if (id_ != 0) glDeleteTextures(1, &id_);
}

VolumeTexture::VolumeTexture(VolumeTexture&& other) noexcept
    : id_(std::exchange(other.id_, 0)),
      internal_(other.internal_),
      texelBytes_(other.texelBytes_),
      size_(other.size_),
      levels_(other.levels_) {}

int64_t VolumeTexture::bytes() const {
  int64_t texels = 0;
  for (int level = 0; level < levels_; ++level) {
    const glm::ivec3 one = size(level);
    texels += int64_t{one.x} * one.y * one.z;
  }
  return texels * texelBytes_;
}

void VolumeTexture::bindTexture(uint32_t unit) const { glBindTextureUnit(unit, id_); }

void VolumeTexture::bindImage(uint32_t unit, Access access, int level) const {
  const GLenum how = access == Access::Read    ? GL_READ_ONLY
                     : access == Access::Write ? GL_WRITE_ONLY
                                               : GL_READ_WRITE;
  glBindImageTexture(unit, id_, level, GL_TRUE, 0, how, internal_);
}

void VolumeTexture::clear(glm::vec4 value) const {
  for (int level = 0; level < levels_; ++level)
    glClearTexImage(id_, level, GL_RGBA, GL_FLOAT, glm::value_ptr(value));
}

void VolumeTexture::write(const std::vector<float>& texels) const {
  assert(texels.size() == size_t{4} * size_t(size_.x) * size_t(size_.y) * size_t(size_.z));
  glTextureSubImage3D(id_, 0, 0, 0, 0, size_.x, size_.y, size_.z, GL_RGBA, GL_FLOAT, texels.data());
}

}  // namespace limen::gl
