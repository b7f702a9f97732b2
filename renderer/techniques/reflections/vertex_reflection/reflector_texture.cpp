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
  const GLint sampling = filter ? GL_LINEAR : GL_NEAREST;
  glTextureParameteri(id_, GL_TEXTURE_MAG_FILTER, sampling);
  glTextureParameteri(id_, GL_TEXTURE_MIN_FILTER, sampling);
  glTextureParameteri(id_, GL_TEXTURE_WRAP_S, cube ? GL_CLAMP_TO_EDGE : GL_REPEAT);
  glTextureParameteri(id_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  bytes_ = int64_t{cube ? 6 : 1} * n * n * (halfFloats ? 8 : 16);
}

ReflectorTexture::~ReflectorTexture() {
  if (id_) glDeleteTextures(1, &id_);
}

void ReflectorTexture::bindTexture(uint32_t unit) const { glBindTextureUnit(unit, id_); }

}  // namespace limen::techniques
