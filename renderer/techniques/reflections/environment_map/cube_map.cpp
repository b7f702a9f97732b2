// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/environment_map/cube_map.h"

#include <epoxy/gl.h>

#include <array>
#include <bit>

namespace limen::techniques {

CubeMap::CubeMap(int resolution, bool mipLevels)
    : faces_(gl::Format::RGBA32F, glm::ivec2(resolution),
             mipLevels ? static_cast<int>(std::bit_width(static_cast<uint32_t>(resolution))) : 1, 6) {
  glGenTextures(1, &cube_);
  glTextureView(cube_, GL_TEXTURE_CUBE_MAP, faces_.id(), GL_RGBA32F, 0, static_cast<GLuint>(faces_.levels()),
                0, 6);
  glTextureParameteri(cube_, GL_TEXTURE_MIN_FILTER, mipLevels ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
  glTextureParameteri(cube_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
}

CubeMap::~CubeMap() { glDeleteTextures(1, &cube_); }

void CubeMap::bindCube(uint32_t unit) const { glBindTextureUnit(unit, cube_); }

void CubeMap::makeLevels() const {
  if (faces_.levels() > 1) glGenerateTextureMipmap(faces_.id());
}

CubeFace cubeFace(int face) {
  constexpr std::array<CubeFace, 6> kFaces = {{{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                               {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                               {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                               {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                               {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                               {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}}};
  return kFaces[static_cast<size_t>(face)];
}

}  // namespace limen::techniques
