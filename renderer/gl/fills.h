// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderer/gl/program.h"

namespace limen::gl {

class Context;

/// Fills images and buffers by compute. NVIDIA's driver takes 5 to 30 times as long for its own clears, of
/// framebuffers too, where they are larger than 64 KiB (H200). Leaves the bindings of image units and of
/// storage blocks and the program as they were; a program that has been deleted while in use is no longer.
class Fills {
 public:
  /// Of the context that is current. Compiles.
  Fills();

  /// A level of a 2D texture, or of an array if it has layers (> 0), of a float or an unsigned format.
  struct Level {
    uint32_t id;
    int level;
    glm::ivec2 sizePx;
    int layers;
    uint32_t internalFormat;
    int64_t texels() const { return int64_t{sizePx.x} * sizePx.y * glm::max(layers, 1); }
  };
  void fill(const Level& level, glm::vec4 value) const;
  void fill(const Level& level, glm::uvec4 value) const;
  /// `bytes`: a multiple of 4; of any size.
  void fillBuffer(uint32_t id, int64_t bytes, uint32_t value) const;

  /// Those of this thread's context if it is a GPU's and so much is to be filled; otherwise null: the
  /// driver's own clears are to be used.
  static const Fills* forBytes(int64_t bytes);
  /// For contexts: made with one, current with it, and gone with it.
  static void madeCurrent(const Context& context);
  static void gone(const Context& context);
  /// Contexts of software renderers that are made current from now on have fills too, for tests.
  static void useOnSoftware(bool use);

 private:
  void dispatch(const Program& program, const Level& level) const;
  ProgramCache programs_;
  const Program *flat_, *layers_, *flatUnsigned_, *layersUnsigned_, *buffer_;
};

}  // namespace limen::gl
