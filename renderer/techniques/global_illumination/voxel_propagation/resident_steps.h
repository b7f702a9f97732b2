// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace limen::techniques {

/// All steps of light in one dispatch, whose groups wait for those around them after each step
/// (propagate_resident.comp.glsl). That takes a GPU that runs all groups at a time, which OpenGL neither
/// promises nor tells: each grid is tried before it is used, and waiting in vain ends, is kept as a fact, and
/// makes all light that arrives not a number.
class ResidentSteps {
 public:
  /// Voxels of a group along each axis: the whole of a small grid.
  static glm::ivec3 tileOf(glm::ivec3 gridSize);
  /// Adds what the shader is compiled with.
  static void define(gl::ShaderDefines& defines, glm::ivec3 tile);

  ResidentSteps(const gl::Program& program, glm::ivec3 gridSize, glm::ivec3 tile, gl::Format field);

  int64_t groups() const { return int64_t{groups_.x} * groups_.y * groups_.z; }
  int64_t bytes() const { return signals_.bytes() + lights_.bytes(); }
  /// From one field to another; all else is set and bound as for a step. Steps: at least 1.
  void run(int from, int to, int steps);
  /// Some steps of whatever the fields hold, to find out whether groups get stuck. Waits for the GPU.
  bool works();
  /// Whether groups have ever waited in vain. Waits for the GPU.
  bool stuck() const;
  /// For arrive.comp.glsl, which looks at `stuck`.
  const gl::Buffer& signals() const { return signals_; }

 private:
  void dispatch(int from, int to, int steps, uint32_t mostPolls);

  const gl::Program& program_;
  glm::ivec3 groups_;
  gl::Buffer signals_, lights_;
  uint32_t firstSignal_ = 0;
};

}  // namespace limen::techniques
