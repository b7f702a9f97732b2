// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/texture.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>
#include <utility>

#include "experiments/base/error.h"
#include "renderer/gl/fills.h"

namespace limen::gl {
namespace {

struct FormatFacts {
  GLenum internal, external, type;
  int channels, bytes;
};

FormatFacts factsOf(Format format) {
  switch (format) {
    case Format::R8:
      return {GL_R8, GL_RED, GL_FLOAT, 1, 1};
    case Format::R16F:
      return {GL_R16F, GL_RED, GL_FLOAT, 1, 2};
    case Format::R32F:
      return {GL_R32F, GL_RED, GL_FLOAT, 1, 4};
    case Format::RG16F:
      return {GL_RG16F, GL_RG, GL_FLOAT, 2, 4};
    case Format::RG32F:
      return {GL_RG32F, GL_RG, GL_FLOAT, 2, 8};
    case Format::RGBA8:
      return {GL_RGBA8, GL_RGBA, GL_FLOAT, 4, 4};
    case Format::RGBA16F:
      return {GL_RGBA16F, GL_RGBA, GL_FLOAT, 4, 8};
    case Format::RGBA32F:
      return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 4, 16};
    case Format::R8UI:
      return {GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 1, 1};
    case Format::R32UI:
      return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 1, 4};
    case Format::RG32UI:
      return {GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, 2, 8};
    case Format::RGBA16UI:
      return {GL_RGBA16UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 4, 8};
    case Format::RGBA32UI:
      return {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 4, 16};
    case Format::Depth32F:
      return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 1, 4};
  }
  return {};
}

glm::ivec2 levelSize(glm::ivec2 size, int level) {
  return glm::max(glm::ivec2(size.x >> level, size.y >> level), 1);
}

GLenum accessOf(Access access) {
  return access == Access::Read ? GL_READ_ONLY : access == Access::Write ? GL_WRITE_ONLY : GL_READ_WRITE;
}

}  // namespace

int bytesPerTexel(Format format) { return factsOf(format).bytes; }
int channelCount(Format format) { return factsOf(format).channels; }
uint32_t internalFormat(Format format) { return factsOf(format).internal; }

Texture::Texture(Format format, glm::ivec2 sizePx, int levels, int layers, Sampling sampling)
    : format_(format), sizePx_(sizePx), levels_(levels), layers_(layers), sampling_(sampling) {
  assert(sizePx.x > 0 && sizePx.y > 0 && levels > 0);
  const FormatFacts facts = factsOf(format);
  glCreateTextures(layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, 1, &id_);
  if (layers > 0)
    glTextureStorage3D(id_, levels, facts.internal, sizePx.x, sizePx.y, layers);
  else
    glTextureStorage2D(id_, levels, facts.internal, sizePx.x, sizePx.y);
  const GLenum error = glGetError();
  if (error == GL_OUT_OF_MEMORY || error == GL_INVALID_VALUE) {
    glDeleteTextures(1, &id_);
    throw Error("the device cannot hold a texture of " + std::to_string(sizePx.x) + " x " +
                    std::to_string(sizePx.y) + (layers > 0 ? " x " + std::to_string(layers) : "") +
                    " texels (" + std::to_string(bytes() >> 20) + " MiB)",
                {}, "choose a smaller size");
  }
  setSampling();
}

void Texture::setSampling() {
  const bool linear = sampling_ == Sampling::Linear;
  const GLint magnify = linear ? GL_LINEAR : GL_NEAREST;
  const GLint minify = levels_ == 1 ? magnify : linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_NEAREST;
  glTextureParameteri(id_, GL_TEXTURE_MAG_FILTER, magnify);
  glTextureParameteri(id_, GL_TEXTURE_MIN_FILTER, minify);
  glTextureParameteri(id_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(id_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

Texture::Texture(uint32_t id, const Texture& of, int layers)
    : id_(id),
      format_(of.format_),
      sizePx_(of.sizePx_),
      levels_(of.levels_),
      layers_(layers),
      sampling_(of.sampling_) {
  setSampling();
}

Texture Texture::view(int firstLayer, int count) const {
  assert(firstLayer >= 0 && firstLayer + std::max(count, 1) <= layers_);
  GLuint id = 0;
  glGenTextures(1, &id);
  glTextureView(id, count > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, id_, factsOf(format_).internal, 0,
                static_cast<GLuint>(levels_), static_cast<GLuint>(firstLayer),
                static_cast<GLuint>(std::max(count, 1)));
  return {id, *this, count};
}

Texture::~Texture() {
  if (clearTarget_) glDeleteFramebuffers(1, &clearTarget_);
  if (id_) glDeleteTextures(1, &id_);
}

Texture::Texture(Texture&& other) noexcept
    : id_(std::exchange(other.id_, 0)),
      clearTarget_(std::exchange(other.clearTarget_, 0)),
      format_(other.format_),
      sizePx_(other.sizePx_),
      levels_(other.levels_),
      layers_(other.layers_),
      sampling_(other.sampling_) {}

Texture& Texture::operator=(Texture&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(clearTarget_, other.clearTarget_);
  format_ = other.format_, sizePx_ = other.sizePx_, levels_ = other.levels_, layers_ = other.layers_;
  sampling_ = other.sampling_;
  return *this;
}

int64_t Texture::bytes() const {
  int64_t texels = 0;
  for (int level = 0; level < levels_; ++level) {
    const glm::ivec2 size = levelSize(sizePx_, level);
    texels += int64_t{size.x} * size.y;
  }
  return texels * std::max(layers_, 1) * bytesPerTexel(format_);
}

void Texture::bindTexture(uint32_t unit) const { glBindTextureUnit(unit, id_); }

void Texture::bindImage(uint32_t unit, Access access, int level) const {
  glBindImageTexture(unit, id_, level, GL_TRUE, 0, accessOf(access), factsOf(format_).internal);
}

// A framebuffer's clear: llvmpipe takes longer for glClearTexImage.
uint32_t Texture::clearTarget(int level) const {
  if (!clearTarget_) glCreateFramebuffers(1, &clearTarget_);
  glNamedFramebufferTexture(clearTarget_, GL_COLOR_ATTACHMENT0, id_, level);
  glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT);
  return clearTarget_;
}

void Texture::clear(glm::vec4 value, int level) const {
  assert(format_ != Format::Depth32F && factsOf(format_).type == GL_FLOAT);
  const Fills::Level whole{id_, level, levelSize(sizePx_, level), layers_, internalFormat(format_)};
  if (const Fills* fills = Fills::forBytes(whole.texels() * bytesPerTexel(format_)))
    return fills->fill(whole, value);
  glClearNamedFramebufferfv(clearTarget(level), GL_COLOR, 0, glm::value_ptr(value));
}

void Texture::clearUint(glm::uvec4 value, int level) const {
  assert(factsOf(format_).type == GL_UNSIGNED_INT);
  const Fills::Level whole{id_, level, levelSize(sizePx_, level), layers_, internalFormat(format_)};
  if (const Fills* fills = Fills::forBytes(whole.texels() * bytesPerTexel(format_)))
    return fills->fill(whole, value);
  glClearNamedFramebufferuiv(clearTarget(level), GL_COLOR, 0, glm::value_ptr(value));
}

Image Texture::read(int level) const {
  const FormatFacts facts = factsOf(format_);
  assert(facts.type == GL_FLOAT && layers_ == 0);
  const glm::ivec2 size = levelSize(sizePx_, level);
  Image image(size.x, size.y, facts.channels);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  glGetTextureImage(id_, level, facts.external, GL_FLOAT,
                    static_cast<GLsizei>(image.data.size() * sizeof(float)), image.data.data());
  return image;
}

Image Texture::readLayer(int layer, int level) const {
  const FormatFacts facts = factsOf(format_);
  assert(facts.type == GL_FLOAT && layer < layers_);
  const glm::ivec2 size = levelSize(sizePx_, level);
  Image image(size.x, size.y, facts.channels);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  glGetTextureSubImage(id_, level, 0, 0, layer, size.x, size.y, 1, facts.external, GL_FLOAT,
                       static_cast<GLsizei>(image.data.size() * sizeof(float)), image.data.data());
  return image;
}

std::vector<uint32_t> Texture::readUint(int level) const {
  const FormatFacts facts = factsOf(format_);
  assert(facts.type == GL_UNSIGNED_INT && layers_ == 0);
  const glm::ivec2 size = levelSize(sizePx_, level);
  std::vector<uint32_t> data(static_cast<size_t>(size.x) * size.y * facts.channels);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  glGetTextureImage(id_, level, facts.external, GL_UNSIGNED_INT, static_cast<GLsizei>(data.size() * 4),
                    data.data());
  return data;
}

std::vector<uint32_t> Texture::readUintLayer(int layer, int level) const {
  const FormatFacts facts = factsOf(format_);
  assert(facts.type == GL_UNSIGNED_INT && layer < layers_);
  const glm::ivec2 size = levelSize(sizePx_, level);
  std::vector<uint32_t> data(static_cast<size_t>(size.x) * size.y * facts.channels);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  glGetTextureSubImage(id_, level, 0, 0, layer, size.x, size.y, 1, facts.external, GL_UNSIGNED_INT,
                       static_cast<GLsizei>(data.size() * 4), data.data());
  return data;
}

void Texture::write(const Image& image, int level) const {
  const FormatFacts facts = factsOf(format_);
  assert(image.channels == facts.channels &&
         levelSize(sizePx_, level) == glm::ivec2(image.width, image.height));
  glTextureSubImage2D(id_, level, 0, 0, image.width, image.height, facts.external, GL_FLOAT,
                      image.data.data());
}

void Texture::writeUint(const std::vector<uint32_t>& texels, int layer) const {
  const FormatFacts facts = factsOf(format_);
  assert(facts.type == GL_UNSIGNED_INT && layer < std::max(layers_, 1) &&
         texels.size() == static_cast<size_t>(sizePx_.x) * sizePx_.y * facts.channels);
  if (layers_ > 0)
    glTextureSubImage3D(id_, 0, 0, 0, layer, sizePx_.x, sizePx_.y, 1, facts.external, GL_UNSIGNED_INT,
                        texels.data());
  else
    glTextureSubImage2D(id_, 0, 0, 0, sizePx_.x, sizePx_.y, facts.external, GL_UNSIGNED_INT, texels.data());
}

Framebuffer::Framebuffer(const std::vector<const Texture*>& colours, const Texture* depth) {
  glCreateFramebuffers(1, &id_);
  std::vector<GLenum> buffers;
  for (const Texture* colour : colours) {
    buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(buffers.size()));
    glNamedFramebufferTexture(id_, buffers.back(), colour->id(), 0);
    sizePx_ = colour->sizePx();
  }
  glNamedFramebufferDrawBuffers(id_, static_cast<GLsizei>(buffers.size()), buffers.data());
  if (depth) {
    glNamedFramebufferTexture(id_, GL_DEPTH_ATTACHMENT, depth->id(), 0);
    sizePx_ = depth->sizePx();
  }
  if (glCheckNamedFramebufferStatus(id_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    glDeleteFramebuffers(1, &id_);
    throw std::runtime_error("the driver cannot render into this combination of textures");
  }
}

Framebuffer::~Framebuffer() {
  if (id_) glDeleteFramebuffers(1, &id_);
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, id_);
  glViewport(0, 0, sizePx_.x, sizePx_.y);
}

}  // namespace limen::gl
