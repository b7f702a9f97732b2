// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/vertex_reflection/reflector_texture.h"

#include <epoxy/gl.h>

#include <vector>

namespace limen::techniques {

ReflectorTexture::ReflectorTexture(const reflections::StarMap& map, bool halfFloats, bool filter) {
  const bool cube = map.layout == reflections::MapLayout::Cube;
  const int n = map.resolution;
  glCreateTextures(cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D, 1, &id_);
  glTextureStorage2D(id_, 1, halfFloats ? GL_RGBA16F : GL_RGBA32F, n, n);
  std::vector<glm::vec4> texels;
  for (const reflections::RadialPoint& at : map.texels)
    texels.emplace_back(glm::dvec4(at.radius, at.gradient.x, at.gradient.y, at.gradient.z));
  if (cube)
    glTextureSubImage3D(id_, 0, 0, 0, 0, n, n, 6, GL_RGBA, GL_FLOAT, texels.data());
  else
    glTextureSubImage2D(id_, 0, 0, 0, n, n, GL_RGBA, GL_FLOAT, texels.data());
  glCreateTextures(cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D, 1, &presentId_);
  glTextureStorage2D(presentId_, 1, GL_R8, n, n);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (cube)
    glTextureSubImage3D(presentId_, 0, 0, 0, 0, n, n, 6, GL_RED, GL_UNSIGNED_BYTE, map.present.data());
  else
    glTextureSubImage2D(presentId_, 0, 0, 0, n, n, GL_RED, GL_UNSIGNED_BYTE, map.present.data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  for (const auto& [texture, linear] : {std::pair{id_, filter}, std::pair{presentId_, false}}) {
    const GLint sampling = linear ? GL_LINEAR : GL_NEAREST;
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, sampling);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, sampling);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, cube ? GL_CLAMP_TO_EDGE : GL_REPEAT);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  bytes_ = int64_t{cube ? 6 : 1} * n * n * (halfFloats ? 9 : 17);
}

ReflectorTexture::~ReflectorTexture() {
  if (id_) glDeleteTextures(1, &id_);
  if (presentId_) glDeleteTextures(1, &presentId_);
}

void ReflectorTexture::bindTextures(uint32_t unit, uint32_t presentUnit) const {
  glBindTextureUnit(unit, id_);
  glBindTextureUnit(presentUnit, presentId_);
}

}  // namespace limen::techniques
