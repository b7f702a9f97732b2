// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/texture_readback.h"

#include <epoxy/gl.h>

#include <array>

#include "perception/metrics/error_map.h"

namespace limen::viewer {
namespace {

bool isWhole(gl::Format format) {
  switch (format) {
    case gl::Format::R8UI:
    case gl::Format::R32UI:
    case gl::Format::RG32UI:
    case gl::Format::RGBA16UI:
    case gl::Format::RGBA32UI:
      return true;
    default:
      return false;
  }
}

GLenum pixelFormat(int channels, bool whole) {
  switch (channels) {
    case 1:
      return whole ? GL_RED_INTEGER : GL_RED;
    case 2:
      return whole ? GL_RG_INTEGER : GL_RG;
    default:
      return whole ? GL_RGBA_INTEGER : GL_RGBA;
  }
}

/// Neighbouring numbers get different colours: three bytes of a multiplicative hash.
std::array<uint8_t, 3> colourOf(uint32_t number) {
  if (number == 0) return {0, 0, 0};
  const uint32_t mixed = (number ^ (number >> 15)) * 2654435761U;
  return {static_cast<uint8_t>(64 + (mixed >> 24) % 192), static_cast<uint8_t>(64 + (mixed >> 16) % 192),
          static_cast<uint8_t>(64 + (mixed >> 8) % 192)};
}

}  // namespace

std::vector<double> valuesAt(const gl::Texture& texture, glm::ivec2 pixel, glm::ivec2 pictureSizePx) {
  if (texture.format() == gl::Format::Depth32F) return {};
  const glm::ivec2 size = texture.sizePx();
  const glm::ivec2 at =
      glm::clamp(glm::ivec2((glm::dvec2(pixel) + 0.5) * glm::dvec2(size) / glm::dvec2(pictureSizePx)),
                 glm::ivec2(0), size - 1);
  const auto channels = static_cast<size_t>(gl::channelCount(texture.format()));
  std::vector<double> out;
  if (isWhole(texture.format())) {
    std::array<GLuint, 4> values{};
    glGetTextureSubImage(texture.id(), 0, at.x, at.y, 0, 1, 1, 1,
                         pixelFormat(static_cast<int>(channels), true), GL_UNSIGNED_INT, sizeof values,
                         values.data());
    out.assign(values.begin(), values.begin() + static_cast<ptrdiff_t>(channels));
  } else {
    std::array<GLfloat, 4> values{};
    glGetTextureSubImage(texture.id(), 0, at.x, at.y, 0, 1, 1, 1,
                         pixelFormat(static_cast<int>(channels), false), GL_FLOAT, sizeof values,
                         values.data());
    out.assign(values.begin(), values.begin() + static_cast<ptrdiff_t>(channels));
  }
  return out;
}

TexturePicture texturePicture(const gl::Texture& texture) {
  TexturePicture out;
  if (texture.format() == gl::Format::Depth32F) return out;
  if (isWhole(texture.format())) {
    const std::vector<uint32_t> numbers = texture.readUint();
    const auto channels = static_cast<size_t>(gl::channelCount(texture.format()));
    out.picture.sizePx = texture.sizePx();
    for (size_t i = 0; i + channels <= numbers.size(); i += channels) {
      const std::array<uint8_t, 3> colour = colourOf(numbers[i]);
      out.picture.rgba.insert(out.picture.rgba.end(), {colour[0], colour[1], colour[2], 255});
    }
    return out;
  }
  const Image image = texture.read();
  if (image.channels >= 3) {
    out.picture = screenPicture(perception::displayPicture(image));
    return out;
  }
  Image first(image.width, image.height, 1);
  for (size_t i = 0; i < first.pixels(); ++i)
    first.data[i] = image.data[i * static_cast<size_t>(image.channels)];
  out.white = perception::errorScale(first);
  out.picture = screenPicture(perception::errorPicture(first, out.white));
  return out;
}

}  // namespace limen::viewer
